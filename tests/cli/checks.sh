# Checks of commands, for the tests that are written in sh. Each check names what it defends.
# They run in a folder of their own, which is removed at the end.
checks=0
failures=0
work=$(mktemp -d)
trap 'chmod -R u+w "$work"; rm -rf "$work"' EXIT
cd "$work" || exit 1
export XDG_CACHE_HOME="$work/caches"

fail() {
  failures=$((failures + 1))
  echo "FAILED: $1"
  sed 's/^/    /' out err
}

# expect EXIT_CODE NAME COMMAND...: runs it, its output in the files out and err
expect() {
  code=$1 name=$2
  shift 2
  checks=$((checks + 1))
  "$@" >out 2>err
  got=$?
  [ $got -eq "$code" ] || fail "$name: exit code $got, expected $code"
}

# says FILE NAME TEXT: the file, such as the last command's out or err, holds the text
says() {
  checks=$((checks + 1))
  grep -qF -- "$3" "$1" || fail "$2: no '$3' in its $1"
}

# says_not FILE NAME TEXT: the file does not hold the text
says_not() {
  checks=$((checks + 1))
  if grep -qF -- "$3" "$1"; then fail "$2: '$3' in its $1"; fi
}

# absent FILES NAME: no such files are there
absent() {
  checks=$((checks + 1))
  [ -z "$(ls -d $1 2>/dev/null)" ] || fail "$2: $1 is there"
}

# is NAME COMMAND...: the command, a condition, holds
is() {
  name=$1
  shift
  checks=$((checks + 1))
  "$@" || fail "$name"
}

# same NAME A B: the two files have the same bytes
same() {
  checks=$((checks + 1))
  cmp -s "$2" "$3" || fail "$1: $2 and $3 differ"
}

# The last line of a test: says the counts, and fails if a check has.
count_checks() {
  echo "$((checks - failures)) passed, $failures failed"
  [ $failures -eq 0 ]
}
