"""Command lines."""

from broken.pieces import TIP, WATCH, usage, wrong

CASES = [
    usage("no verb", "", "A subcommand is required"),
    usage("unknown verb", "chekc deck.xml", "unknown command 'chekc' – did you mean 'check'?"),
    usage("no deck named", "run", "deck is required"),
    usage("unknown option", "run deck.xml --frob", "unknown option '--frob' (allowed: --help, --set"),
    wrong(
        "distance to nothing",
        TIP + WATCH,
        "@@" + TIP + 'value="Distance"/>\n        <Parameter name="Node" value="beam/last"/>',
        "Output / History / tip: needs either 'To' or 'Structure'",
    ),
    wrong(
        "section loads beyond the end",
        WATCH,
        'value="Section Loads"/>\n        <Parameter name="Structure" value="beam"/>'
        '\n        @@<Parameter name="Station" value="1.5"/>',
        "Output / History / tip / Station: must be between 0 and 1, got 1.5",
    ),
    usage("empty name of a folder", "run deck.xml --output ''", "--output: needs a path, got ''"),
    usage("empty name of a file", "check deck.xml --resolved ''", "--resolved: needs a path, got ''"),
    usage("misspelt option", "run deck.xml --stirct", "unknown option '--stirct' – did you mean '--strict'?"),
    usage(
        "misspelt option with a value, and no deck",
        "run --outptu=here",
        "unknown option '--outptu' – did you mean '--output'?",
    ),
    usage(
        "misspelt option of a verb in Python",
        "report out --quite",
        "unknown option '--quite' – did you mean '--quiet'?",
    ),
    usage("a word too many for a verb in Python", "report out more", "'more' is one word too many"),
    usage("two decks", "run deck.xml deck2.xml", "deck2.xml"),
    usage("--output without a folder", "run deck.xml --output", "--output"),
    usage(
        "--set without a value",
        "run deck.xml --output out --set Title",
        "--set needs 'List/Parameter=value', got 'Title'",
        ranks=True,
    ),
    usage(
        "--set with an empty name",
        "run deck.xml --output out --set Analyses//Steps=3",
        "--set has an empty name in 'Analyses//Steps=3'",
    ),
    usage(
        "reference of an unknown name",
        "reference Tub",
        "the input reference has no 'Tub' – did you mean 'Tube'?",
    ),
    usage(
        "title that is no UTF-8",
        "run deck.xml --output out --set 'Title=a\udcff'",
        "--set is no valid UTF-8 in 'Title=a\\xff'\n",
        ranks=True,
    ),
    usage(
        "memory without a unit",
        "run deck.xml --output out --max-memory 16",
        "--max-memory needs a size such as '500 MB' or '16 GB', got '16'\n",
    ),
    usage("unknown verb on several processes", "chekc", "unknown command 'chekc'", ranks=True),
]
