#!/bin/sh
# compile_with_headers.sh COMPILER ARGUMENTS...: starts the compiler, which may make or use a
# precompiled header. These are files of 100 to 250 MB that GCC maps into its memory, and one that
# lacks a piece, because a build was killed or a virtual disk lost it, makes the compiler fail
# ("PCH allocation failure", a bus error, errors that nobody made) or take all memory. So each is
# tried on an empty source and made again if need be; and where a source does not compile with its
# header, the same headers go in as text.
ulimit -v 8000000 2>/dev/null || : # KB; no source takes half of it

# try_header ARGUMENTS...: whether an empty source compiles with the header that these made
try_header() {
  count=$#
  skip=no
  for argument; do
    if [ $skip = yes ]; then
      skip=no
      continue
    fi
    case $argument in
      -o | -c | -MT | -MF) skip=yes ;;
      -MD) ;;
      c++-header) set -- "$@" c++ ;;
      *) set -- "$@" "$argument" ;;
    esac
  done
  shift "$count"
  timeout 120 "$@" -fsyntax-only /dev/null >/dev/null 2>&1
}

case "$*" in
  *" c++-header "*)
    for attempt in 1 2 3; do
      "$@" || exit $?
      try_header "$@" && exit 0
      export CCACHE_RECACHE=1
    done
    echo "compile_with_headers.sh: the precompiled header is of no use each time it is made" >&2
    exit 1
    ;;
esac

log=$(mktemp) || exit 1
trap 'rm -f "$log"' EXIT
"$@" 2>"$log"
status=$?
case "$*" in
  */cmake_pch.hxx*) ;;
  *) header=no ;;
esac
if [ $status -eq 0 ] || [ "$header" = no ]; then
  cat "$log" >&2
  exit $status
fi
count=$#
for argument; do
  case $argument in
    */cmake_pch.hxx)
      # The compiler looks for the precompiled form beside the text. The copy stays: it is in the
      # list of what the object depends on.
      text=${argument%/*}/text
      mkdir -p "$text" && cp -p "$argument" "$text/$$" && mv "$text/$$" "$text/cmake_pch.hxx" \
        || exit 1
      argument=$text/cmake_pch.hxx
      ;;
  esac
  set -- "$@" "$argument"
done
shift "$count"
"$@"
