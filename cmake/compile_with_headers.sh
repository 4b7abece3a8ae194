#!/bin/sh
# compile_with_headers.sh COMPILER ARGUMENTS...: starts the compiler. GCC maps a precompiled header
# whole at one address and gives up ("PCH allocation failure") where a machine denies it that, for
# want of address space or of memory it may promise; a file that was cut off, as when a build was
# killed, ends it with a bus error. The same headers then go in as text.
log=$(mktemp) || exit 1
trap 'rm -f "$log"' EXIT
"$@" 2>"$log"
status=$?
if [ $status -eq 0 ] || ! grep -qE 'PCH allocation failure|Bus error' "$log"; then
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
