# Sourced by the scripts that a person runs: names each step, times it, and ends with one clear line where it fails.

fail() {
  echo "${0##*/}: $*" >&2
  exit 1
}

# step NAME COMMAND...: runs the command and says how long it took.
step() {
  local name=$1 begin=$SECONDS
  shift
  echo "== $name"
  "$@" || fail "'$name' failed; the lines above say why"
  echo "== $name: $((SECONDS - begin)) s"
}
