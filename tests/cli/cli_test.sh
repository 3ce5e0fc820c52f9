#!/bin/sh
# Drives the command line as a user would: cli_test.sh PROHULL
# Each check names what it defends; the last line counts them.
set -u
prohull=$1
work=$(mktemp -d)
trap 'chmod -R u+w "$work"; rm -rf "$work"' EXIT
cd "$work" || exit 1
checks=0
failures=0

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

# says FILE NAME TEXT: the last command's out or err holds the text
says() {
  checks=$((checks + 1))
  grep -qF -- "$3" "$1" || fail "$2: no '$3' in its $1"
}

absent() {
  checks=$((checks + 1))
  [ -z "$(ls $1 2>/dev/null)" ] || fail "$2: $1 is there"
}

# --- the main job ---
expect 0 "sample" $prohull sample asteroid -o rock.ply --faces 20000
expect 0 "build" $prohull build rock.ply --faces 500 -o hull.stl --hierarchy rock.phull --report hull.json
says out "build tells the faces" "outer hull of 500 faces"
says out "build certifies" "certified: yes"
says hull.json "report: certified" '"certified": true'
says hull.json "report: stopped" '"stopped": "target_reached"'
says hull.json "report: void" '"void_ratio": 0.'
expect 0 "verify two files" $prohull verify hull.stl rock.ply --report verify.json
says verify.json "report: encloses" '"encloses": true'
expect 0 "verify a proof" $prohull verify rock.phull rock.ply
expect 1 "verify the wrong way round" $prohull verify rock.ply hull.stl --report verify.json
says out "verify names offenders" "outside"
says verify.json "report: offenders" '"point"'
expect 1 "a proof of another mesh" $prohull verify rock.phull hull.stl
expect 0 "info of a mesh" $prohull info rock.ply
says out "info" "closed 2-manifold"
expect 0 "info of a .phull" $prohull info rock.phull
says out "info of a .phull" "progressive hull"
expect 0 "lod" $prohull lod rock.phull --faces 5000 -o level.obj
expect 0 "a level encloses" $prohull verify level.obj rock.ply
expect 0 "a level encloses the next" $prohull verify hull.stl level.obj
expect 0 "lod to float32" $prohull lod rock.phull --faces 10000 -o level.stl
expect 0 "a float32 level encloses" $prohull verify level.stl rock.ply
expect 0 "the finest level" $prohull lod rock.phull --faces 20000000 -o finest.ply
checks=$((checks + 1))
cmp -s finest.ply rock.ply || fail "the finest level is the original, bit for bit"

expect 0 "inner hull" $prohull build rock.ply --side inner --faces 500 -o inner.obj --hierarchy inner.phull
says out "inner hull" "inner hull of 500 faces"
expect 0 "inner hull verified" $prohull verify inner.obj rock.ply --side inner
expect 0 "inner proof verified" $prohull verify inner.phull rock.ply
expect 1 "an inner hull does not enclose" $prohull verify inner.obj rock.ply

for strategy in paper1 paper2; do
  expect 0 "$strategy" $prohull build rock.ply --strategy $strategy --faces 500 -o hull.off
  says out "$strategy certified" "certified: yes"
done

expect 0 "formats" $prohull build hull.stl --faces 100 -o out.obj
gzip -kf rock.ply
expect 0 "gzip" $prohull build rock.ply.gz --faces 500 -o from_gzip.stl
cmp -s from_gzip.stl hull.stl || fail "the same hull from a gzipped file"

# --- what cannot be reached ---
$prohull sample box -o box.ply --faces 2000 >/dev/null
expect 0 "the least face count" $prohull build box.ply --faces 4 -o least.ply
says out "tells why it stopped" "no legal collapse is left"
expect 1 "--strict" $prohull build box.ply --faces 4 -o least.ply --strict

# --- wrong usage is 2 ---
expect 2 "no command" $prohull
expect 2 "unknown option" $prohull build rock.ply -o x.ply --face 10
expect 2 "no output" $prohull build rock.ply
expect 2 "too few faces" $prohull build rock.ply --faces 3 -o x.ply
says err "too few faces" "4"
expect 2 "negative faces" $prohull build rock.ply --faces -5 -o x.ply
expect 2 "angle out of range" $prohull build rock.ply --normal-deviation 91 -o x.ply
expect 2 "hierarchy over the input" $prohull build rock.ply -o x.ply --hierarchy rock.ply
says err "hierarchy over the input" "named twice"
expect 2 "output in .gz" $prohull build rock.ply -o x.ply.gz
expect 2 "unknown sample" $prohull sample cow -o x.ply
says err "unknown sample" "sphere"
expect 0 "help" $prohull build --help
says out "help has examples" "prohull build"

# --- bad input is 3, one line, with an address ---
bad() {
  expect 3 "$1" $prohull build "$2" -o bad_out.ply
  says err "$1" "$3"
  checks=$((checks + 1))
  [ "$(wc -l <err)" -eq 1 ] || fail "$1: not one line"
  absent "bad_out.ply*" "$1"
}
head -c 1000 rock.ply >truncated.ply
bad "truncated file" truncated.ply "truncated.ply: byte"
bad "missing file" nowhere.ply "nowhere.ply"
bad "folder as file" . "."
printf 'OFF\n4 4 0\n0 0 0\n1 0 0\n0 nan 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n' >nan.off
bad "NaN" nan.off "line 5"
printf 'OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 9\n3 1 2 3\n3 2 0 3\n' >index.off
bad "index out of range" index.off "line 8"
printf 'OFF\n4 3 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n' >open.off
bad "open mesh" open.off "has 1 face"
printf 'OFF\n0 0 0\n' >empty.off
bad "empty mesh" empty.off "no faces"
printf 'OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 2 1\n' >flat.off
bad "no volume" flat.off "no volume"
printf 'OFF\n4 4 0\n0 0 0\n1e200 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n' >huge.off
bad "huge coordinates" huge.off "scale the mesh"
bad "unknown format" hull.json "hull.json"
head -c 5000 rock.phull >truncated.phull
expect 3 "truncated .phull" $prohull info truncated.phull
says err "truncated .phull" "truncated"
expect 3 "a mesh is no .phull" $prohull lod rock.ply -o x.ply

$prohull sample sphere -o sphere.obj --faces 5000 >/dev/null
awk '/^v / { printf "v %.9e %.9e %.9e\n", $2 * 3.4e38, $3 * 3.4e38, $4 * 3.4e38; next } { print }' sphere.obj >edge.obj
expect 0 "at the edge of float32" $prohull build edge.obj -o edge.stl --faces 100
says out "at the edge of float32" "certified: yes"

# An inside-out mesh is turned, and the turned one is what the hull encloses.
printf 'OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n3 0 3 1\n3 1 3 2\n3 2 3 0\n' >inside_out.off
expect 0 "inside out" $prohull build inside_out.off -o tetrahedron.ply
says out "inside out" "inside out"
expect 0 "inside out, verified" $prohull verify tetrahedron.ply inside_out.off

# --- nothing half-written ---
expect 3 "no such folder" $prohull build rock.ply --faces 500 -o nowhere/hull.ply
says err "no such folder" "nowhere/hull.ply"
if [ "$(id -u)" -ne 0 ]; then
  mkdir read_only && chmod a-w read_only
  expect 3 "read-only folder" $prohull build rock.ply --faces 500 -o read_only/hull.ply
  says err "read-only folder" "read_only/hull.ply"
fi
$prohull sample asteroid -o big.ply --faces 400000 >/dev/null
$prohull build big.ply --faces 500 -o interrupted.ply --hierarchy interrupted.phull >out 2>err &
sleep 0.3
kill -INT $! 2>/dev/null
wait $!
code=$?
checks=$((checks + 1))
# A background job of a shell ignores Ctrl-C unless the program asks for it, as prohull does.
[ $code -eq 130 ] || fail "Ctrl-C: exit code $code, expected 130"
absent "interrupted*" "Ctrl-C"

echo "$((checks - failures)) passed, $failures failed"
[ $failures -eq 0 ]
