"""Self-contained HTML pages: text, tables, pictures; readable on a screen and in print."""

import base64
import html
import io

from .whole_file import write_whole

STYLE = """
body{font:15px/1.5 system-ui,sans-serif;max-width:60rem;margin:2rem auto;padding:0 1rem;color:#222}
h1{font-size:1.6rem;margin-bottom:.2rem}h2{font-size:1.2rem;margin-top:2rem}
table{display:block;overflow-x:auto;border-collapse:collapse;margin:.8rem 0;font-variant-numeric:tabular-nums;font-size:.9rem}
th,td{padding:.2rem .7rem;border-bottom:1px solid #ddd;text-align:right}
th:first-child,td:first-child{text-align:left}thead th{border-bottom:2px solid #888}
pre{background:#f6f6f4;padding:.8rem;overflow-x:auto;font-size:.82rem;line-height:1.35}
img{max-width:100%}p.advice{background:#eef4ea;border-left:4px solid #6a9a4a;padding:.6rem 1rem}
p.warning{background:#fbf0e6;border-left:4px solid #c77a30;padding:.6rem 1rem}
p.broken{background:#fbe4e4;border-left:4px solid #c02020;padding:.6rem 1rem;color:#901010;font-weight:600}
tr.broken td{color:#c02020}
@media print{body{max-width:none;margin:0}h2{break-after:avoid}table,img,pre{break-inside:avoid}}
"""


class Page:
    """Collects the parts of a page in their order."""

    def __init__(self, title, subtitle=""):
        self.title = title
        self.parts = [f"<h1>{html.escape(title)}</h1>"]
        if subtitle:
            self.parts.append(f"<p>{html.escape(subtitle)}</p>")

    def heading(self, text):
        self.parts.append(f"<h2>{html.escape(text)}</h2>")

    def paragraph(self, text, kind=""):
        """@param kind '', 'advice', 'warning' or 'broken'"""
        attribute = f' class="{kind}"' if kind else ""
        self.parts.append(f"<p{attribute}>{html.escape(text)}</p>")

    def code(self, text):
        self.parts.append(f"<pre>{html.escape(text)}</pre>")

    def table(self, columns, rows, broken=()):
        """Cells are texts; the first column is aligned to the left.

        @param broken  numbers of rows to stand in red
        """
        head = "".join(f"<th>{html.escape(c)}</th>" for c in columns)
        body = "".join(
            ('<tr class="broken">' if number in broken else "<tr>")
            + "".join(f"<td>{html.escape(str(c))}</td>" for c in row)
            + "</tr>\n"
            for number, row in enumerate(rows)
        )
        self.parts.append(f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>")

    def figure(self, figure, description):
        """A figure of matplotlib, as a picture within the page; returns the picture."""
        data = io.BytesIO()
        figure.savefig(data, format="png", dpi=130)
        text = base64.b64encode(data.getvalue()).decode()
        alt = html.escape(description, quote=True)
        self.parts.append(f'<p><img alt="{alt}" src="data:image/png;base64,{text}"></p>')
        return data.getvalue()

    def write(self, path):
        body = "\n".join(self.parts)
        write_whole(
            path,
            '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">'
            '<meta name="viewport" content="width=device-width">'
            f"<title>{html.escape(self.title)}</title><style>{STYLE}</style></head>\n"
            f"<body>\n{body}\n</body></html>\n",
        )
