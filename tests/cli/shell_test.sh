#!/bin/bash
# What shells complete, and the manual page: shell_test.sh PROHULL. fish and man are asked where they are installed.
set -u
prohull=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
failures=0

fail() {
  failures=$((failures + 1))
  echo "FAILED: $1"
}

# same WHAT EXPECTED GOT
same() {
  [ "$2" = "$3" ] || fail "$1: '$3', expected '$2'"
}

one_line() {
  sort | paste -sd ' '
}

mkdir parts
touch part.stl PART.PLY arm.dae scan.obj.gz hull.phull segments.npy hits.csv notes.txt picture.png
words="auto none wrap"
read_files="PART.PLY arm.dae hull.phull part.stl parts scan.obj.gz"

# --- bash ---
# bash_completes EXPECTED WORD...: the last word is the one to complete; EXPECTED is sorted
bash_completes() {
  local expected=$1
  shift
  COMP_WORDS=(prohull "$@")
  COMP_CWORD=$#
  _prohull
  same "bash: prohull $*" "$expected" "$(printf '%s\n' "${COMPREPLY[@]}" | one_line)"
}
LC_ALL=C
"$prohull" completion bash >prohull.bash || fail "completion bash"
. ./prohull.bash
same "bash: registered" "complete -F _prohull prohull" "$(complete -p prohull)"
bash_completes "build" b
bash_completes "--version" --v
bash_completes "$read_files" build ""
bash_completes "part.stl parts" build part
bash_completes "part.stl parts" build --faces 500 --tight part
bash_completes "--max-distance --max-normal-deviation --max-overhang --max-valence --max-void" build part.stl --max-
bash_completes "$words" build part.stl --repair ""
bash_completes "wrap" build part.stl --repair w
bash_completes "$words" build part.stl --repair =
bash_completes "wrap" build part.stl --repair = w
bash_completes "" build part.stl --faces ""
bash_completes "PART.PLY part.stl parts" build part.stl -o ""
bash_completes "hull.phull parts" lod ""
bash_completes "hits.csv parts segments.npy" query part.stl --segments ""
bash_completes "knot" sample k
bash_completes "kdop6 kdop6-overlap" query part.stl --engine kdop6
bash_completes "bash fish zsh" completion ""
bash_completes "" no-such-command ""

# --- fish ---
# fish_completes EXPECTED LINE
fish_completes() {
  same "fish: prohull $2" "$1" \
    "$(HOME=$work fish --no-config -c "source prohull.fish; complete -C 'prohull $2'" | cut -f 1 | one_line)"
}
"$prohull" completion fish >prohull.fish || fail "completion fish"
if command -v fish >/dev/null; then
  fish_completes "build" b
  fish_completes "PART.PLY arm.dae hull.phull part.stl parts/ scan.obj.gz" "build "
  fish_completes "$words" "build part.stl --repair "
  fish_completes "PART.PLY part.stl parts/" "build part.stl -o "
  fish_completes "" "build part.stl --faces "
fi

# --- zsh ---
"$prohull" completion zsh >_prohull || fail "completion zsh"
if command -v zsh >/dev/null; then
  zsh -n _prohull || fail "zsh reads it"
fi

# --- the manual page ---
"$prohull" manual >prohull.1 || fail "manual"
if command -v man >/dev/null; then
  same "man has nothing to say" "" "$(MANWIDTH=80 LC_ALL=C.UTF-8 man --warnings -l prohull.1 2>&1 >/dev/null)"
fi

# Whatever --help shows is in each of them.
commands=$("$prohull" --help | sed -n '/^Commands:/,/^$/s/^  \([a-z]*\) .*/\1/p')
[ "$(echo "$commands" | wc -l)" -ge 9 ] || fail "only these commands found: $commands"
for command in $commands; do
  names=$("$prohull" help --all "$command" | grep -oE '^  (-[a-z], )?--[a-z0-9-]+(, --[a-z0-9-]+)*' | grep -oE -- '-[-a-z0-9]+')
  options=$(echo "$names" | grep -- '^--')
  echo "$options" | grep -qx -- --help || fail "no options of $command found"
  bash_completes "$(echo "$names" | one_line)" "$command" -
  for option in $options; do
    grep -q -- "__fish_seen_subcommand_from $command' .*-l ${option#--}\b" prohull.fish || fail "fish: $command $option"
    sed -n "/^    $command)/,/;;/p" _prohull | grep -q -- "$option[=[]" || fail "zsh: $command $option"
    [ "$option" = --help ] && continue
    sed -n "/^.SS $command$/,/^.SS/p" prohull.1 | sed 's/\\-/-/g' | grep -q -- "^.*\\\\fB$option\\\\fR" || fail "manual: $command $option"
  done
done

[ $failures -eq 0 ] && echo "shells and the manual page have all commands"
exit $((failures > 0))
