# Read by the scripts beside it: where the tree is, how programs start, how to build quietly.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

# Open MPI refuses root (the usual user of a container), more ranks than cores, and pins ranks.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
export OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_hwloc_base_binding_policy=none
export OMPI_MCA_btl_vader_single_copy_mechanism=none  # needs a right that containers lack
export OPENBLAS_NUM_THREADS=1

# Runs a command; shows what it printed only when it fails.
quietly() {
  local log status=0
  log=$(mktemp)
  "$@" >"$log" 2>&1 || status=$?
  if ((status)); then
    cat "$log" >&2
    echo "failed: $*" >&2
  fi
  rm -f "$log"
  return $status
}

# build PRESET [TARGET]: configures once, then builds what has changed.
build() {
  local preset=$1 folder=$root/build/$1
  mkdir -p "$folder"
  # A build folder that came from elsewhere with a copied tree is of no use.
  if [[ -f $folder/CMakeCache.txt ]] \
    && ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$folder/CMakeCache.txt"; then
    rm -rf "$folder"
    mkdir -p "$folder"
  fi
  (
    flock 9  # two builds in one folder would spoil each other
    if [[ ! -f $folder/build.ninja ]]; then
      echo "configuring and building in build/$preset; the first time takes minutes" >&2
      cd "$root" && quietly cmake --preset "$preset" || exit 1
    fi
    quietly cmake --build "$folder" --parallel "$(nproc)" ${2:+--target "$2"}
  ) 9>"$folder/.lock"
}
