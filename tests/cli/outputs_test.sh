# What becomes of the files that a command writes, and of what it quotes
export TMPDIR="$work/temporary"
mkdir temporary
$prohull sample torus -o mesh.ply --faces 200 >/dev/null
build="$prohull build mesh.ply --faces 50"

# --- one file under two names ---
mkdir folder
touch there.ply
ln there.ply hard.ply
ln -s there.ply soft.ply
ln -s missing.ply dangling.ply
ln -s folder other
ln mesh.ply hard_mesh.ply
# twice NAME FIRST SECOND: two outputs that are one file
twice() {
  expect 2 "$1" $build -o "$2" --report "$3"
  says err "$1" "are one file, which would be overwritten; choose another name"
}
expect 2 "the same name" $build -o x.ply --report x.ply
says err "the same name" "x.ply is named twice, and would be overwritten"
twice "./" x.ply ./x.ply
twice "/./" folder/x.ply folder/./x.ply
twice "an absolute name" x.ply "$work/x.ply"
twice ".." x.ply folder/../x.ply
twice "a link to a folder" folder/x.ply other/x.ply
twice "a hard link" there.ply hard.ply
twice "a soft link" there.ply soft.ply
twice "a link to nothing" missing.ply dangling.ply
absent "x.ply folder/* missing.ply" "one file under two names"
for spelled in mesh.ply ./mesh.ply hard_mesh.ply folder/../mesh.ply; do
  expect 2 "the input as $spelled" $build -o $spelled
  says err "the input as $spelled" "would be overwritten"
done

# --- modes ---
mode() { stat -c %a "$1"; }
umask 027
expect 0 "a new file" $build -o new.ply --report new.json
is "a new file has the mode of the umask" test "$(mode new.ply) $(mode new.json)" = "640 640"
touch old.ply old.json
chmod 604 old.ply
chmod 400 old.json
expect 0 "a file that is replaced" $build -o old.ply --report old.json
is "a file that is replaced keeps its mode" test "$(mode old.ply) $(mode old.json)" = "604 400"
expect 0 "by a link" $build -o soft.ply
is "a link stays a link" test -L soft.ply
expect 0 "by a link to nothing" $build -o dangling.ply
is "a link that led to nothing leads to the file" test -L dangling.ply -a -s missing.ply

# --- standard output ---
expect 0 "standard output" $build -o - --out-format ply --quiet
is "standard output has the file" cmp -s out new.ply
if [ -e /dev/full ]; then
  into_full() { "$@" >/dev/full; }
  while read -r lost; do
    expect 3 "an answer that is lost: $lost" into_full $prohull $lost
    is "an answer that is lost: $lost" test "$(tail -n 1 err | cut -d: -f1-3)" = "prohull: standard output: cannot write"
  done <<END
info mesh.ply
verify mesh.ply mesh.ply
build mesh.ply --faces 50 -o lost.ply
help build
manual
completion bash
--version
info mesh.ply --report -
END
  expect 3 "why an answer is lost" into_full $prohull verify mesh.ply mesh.ply
  is "why an answer is lost" test "$(cat err)" = "prohull: standard output: cannot write: No space left on device"
  expect 2 "an error is told first" into_full $prohull info --no-such-option
  expect 0 "nothing to lose" into_full $build -o new.ply --quiet
fi
into_closed_pipe() { { trap '' PIPE; "$@" 2>err; echo $? >code; } | true; }
into_closed_pipe sh -c "sleep 0.2; $prohull info mesh.ply"
is "a reader who goes away is no error" test "$(cat code)" = 0
mkfifo fifo
$build -o - --out-format ply --quiet >fifo 2>err &
cat fifo >piped.ply
wait $!
is "a pipe has the file" cmp -s piped.ply new.ply
$prohull sample knot -o big.ply --faces 200000 >/dev/null
for signal in HUP TERM INT; do
  $prohull sample knot --faces 3e7 -o - --out-format ply >/dev/null 2>err &
  for _ in $(seq 400); do
    seen=$(ls temporary)
    [ -n "$seen" ] && break
    sleep 0.02
  done
  for file in temporary/*; do
    if [ -e "$file" ]; then is "nobody else reads $file" test "$(mode "$file")" = 600; fi
  done
  kill -$signal $!
  wait $!
  code=$?
  is "SIG$signal: exit code $code" test $code -eq 130
  says err "SIG$signal" "nothing was written"
  absent "temporary/*" "SIG$signal"
done
is "temporaries have no number of a process" test "$(echo "$seen" | tr -d -c 0-9a-f | wc -c)" -ge 16

# --- SIGHUP ---
$prohull build big.ply --faces 500 --tight -o interrupted.ply >out 2>err &
sleep 0.4
kill -HUP $!
wait $!
code=$?
is "SIGHUP: exit code $code" test $code -eq 130
absent "interrupted* .interrupted*" "SIGHUP"
trap '' HUP
$prohull build big.ply --faces 500 -o nohup.ply >out 2>err &
trap - HUP
sleep 0.3
kill -HUP $!
wait $!
code=$?
is "nohup: exit code $code" test $code -eq 0 -a -s nohup.ply

# --- control characters ---
escape=$(printf '\033')
hostile="a${escape}[2J.ply"
# harmless FILE NAME: it holds no escape character, but its name
harmless() {
  is "$2: no control characters" test -z "$(tr -d '\n\t -~' <"$1" | LC_ALL=C tr -d '\302-\364\200-\277')"
  says "$1" "$2" '\x1b['
}
expect 3 "a hostile name" $prohull info "$hostile"
harmless err "a hostile name"
expect 2 "a hostile option" $prohull info "--no${escape}[2J"
harmless err "a hostile option"
cp mesh.ply "$hostile"
expect 0 "a hostile name of a mesh" $prohull info "$hostile"
harmless out "a hostile name of a mesh"
lines="a
b	c.ply"
expect 3 "a name of two lines" $prohull info "$lines"
is "a name of two lines" test "$(cat err)" = 'prohull: a\x0ab\x09c.ply: cannot read: there is no such file; look at its name and its folder'
expect 2 "an option of two lines" $prohull info "--no$lines"
is "an option of two lines" test "$(wc -l <err)" = 2
printf '<robot name="r"><link name="a\302\233[2J"/><joint name="%s[2J"/></robot>' "$escape" >hostile.urdf
expect 3 "a hostile robot" $prohull urdf hostile.urdf -o robot
is "a hostile robot: no control characters" test -z "$(LC_ALL=C tr -d '\n\t -~' <err)"
longest=$(printf '%0251d' 0)
expect 0 "the longest name" $prohull repair mesh.ply -o "$longest.ply"
expect 0 "the longest name" $prohull info "$longest.ply" --report "a.${longest}00"
expect 0 "a name in another alphabet" cp mesh.ply "größe.ply"
expect 0 "a name in another alphabet" $prohull info "größe.ply"
says out "a name in another alphabet" "größe.ply"

# Several meshes
mkdir parts
cp mesh.ply parts/one.ply
gzip -c mesh.ply >parts/two.ply.gz
expect 0 "a folder of meshes" $prohull build parts -o hulls/ --faces 60,30
is "a folder of meshes" test "$(ls hulls | tr '\n' ' ')" = "one_30.ply one_60.ply two_30.ply two_60.ply "
says out "a folder of meshes" "2 of 2 meshes: as asked"
cp parts/one.ply three.ply
echo broken >four.off
expect 3 "a mesh that is broken" $prohull build four.off three.ply -o 'hulls/{name}.stl' --faces 30 --report 'hulls/{name}.json'
says err "a mesh that is broken" "four.off: "
says out "a mesh that is broken" "1 of 2 meshes: as asked"
is "a mesh that is broken: the other has its files" test -s hulls/three.stl -a -s hulls/three.json
absent "hulls/four*" "a mesh that is broken"
expect 1 "a bound that one misses" $prohull build parts -o missed/ --faces 8 --strict --keep-guards --repair none --max-valence 3
expect 2 "one name for two" $prohull build parts -o one.stl
says err "one name for two" "several meshes need several names"
says err "one name for two" "as in -o '{name}.stl', or end -o in / for a folder"
absent one.stl "one name for two"
expect 2 "one report for two" $prohull build parts -o hulls/ --report parts/r.json
says err "one report for two" "as in --report 'parts/{name}.json'"
expect 2 "a name of standard input" sh -c "$prohull build parts/*.ply - -o hulls/ --faces 30 <four.off"
says err "a name of standard input" "hulls/{name}.stl: standard input has no name that could stand there"
absent "hulls/-*" "a name of standard input"
expect 2 "one name for two hulls of each" $prohull build parts -o 'hulls/{name}.stl' --faces 20,12
says err "one name for two hulls of each" "as in hulls/{name}_{faces}.stl"
is "one name for two hulls of each: said once" test "$(wc -l <err)" = 1
says_not out "one name for two hulls of each: no table" "mesh"
expect 2 "a hierarchy of two hulls" $prohull build parts -o hulls/ --faces 20,12 --hierarchy 'hulls/{name}.phull'
is "a hierarchy of two hulls: said once" test "$(wc -l <err)" = 1
printf 'OFF\n5 5 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\nnan 0 0\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 4\n3 2 3 4\n' >holed.off
expect 0 "caveats in a table" $prohull build holed.off three.ply -o 'hulls/{name}.stl' --faces 30
says out "caveats in a table" "yes, of finite triangles (2 are not), with openings closed ("
$prohull build parts -o pairs/ --faces 60 >/dev/null
expect 0 "two folders" $prohull verify pairs parts --finite-only
says out "two folders" "2 of 2 meshes: as asked"
cp three.ply pairs/other.ply
expect 3 "a hull without a mesh" $prohull verify pairs parts --report 'pairs/{name}_report.json'
says err "a hull without a mesh" "pairs/other.ply: parts has no mesh of this name that has no other hull"
is "two folders: reports" test -s pairs/one_report.json -a -s pairs/two_report.json
mv pairs/other.ply pairs/three.ply
rm pairs/two.ply
cp parts/one.ply parts/three.ply
expect 3 "a mesh without a hull" $prohull verify pairs parts
says err "a mesh without a hull" "parts/two.ply.gz: pairs has no mesh file of this name"
says out "a hull that is the mesh" "2 of 3 meshes: as asked"
rm parts/three.ply
mkdir kinds
$prohull sample box --faces 100 -o kinds/a.ply >/dev/null
$prohull sample sphere --faces 100 -o kinds/a.obj >/dev/null
$prohull build kinds -o kind_hulls/ --faces 60 >/dev/null
expect 0 "meshes that differ in the suffix" $prohull verify kind_hulls kinds
says out "meshes that differ in the suffix" "2 of 2 meshes: as asked"
rm kinds/a.ply kinds/a.obj
$prohull sample box --faces 100 -o kinds/a.off >/dev/null
expect 3 "two hulls of one name" $prohull verify kind_hulls kinds
says err "two hulls of one name" "kinds/a.off: kind_hulls has several mesh files of this name, a.obj and a.ply; give the two files"
rm kind_hulls/a.obj
$prohull sample sphere --faces 100 -o kinds/a.obj >/dev/null
expect 3 "a hull that may be of two meshes" $prohull verify kind_hulls kinds
says err "a hull that may be of two meshes" "kinds/a.off: kind_hulls has no mesh file of this name, or only one that may be another mesh's"
expect 2 "one report for two" $prohull verify pairs parts --report r.json
says err "one report for two" "as in --report '{name}.json'"
expect 0 "pieces of a folder" $prohull convex parts -o pieces/ --pieces 2
says out "pieces of a folder" "2 of 2 meshes: as asked"
is "pieces of a folder" test "$(ls pieces | tr '\n' ' ')" = "one.obj two.obj "
expect 0 "pieces of a folder cover it" $prohull verify --union pieces/two.obj parts/two.ply.gz
expect 0 "pieces of a folder, for an engine" $prohull convex parts -o pieces/ --pieces 2 --for godot
is "pieces of a folder, for an engine" test -s pieces/one.glb -a -s pieces/two.glb
expect 1 "pieces that keep no bound" $prohull convex parts -o pieces/ --pieces 1 --vertices 4 --max-void 0.01
says out "pieces that keep no bound" "0 of 2 meshes: as asked"
expect 2 "pieces of one name" $prohull convex parts -o pieces.obj
says err "pieces of one name" "or end -o in / for a folder"
expect 3 "a folder that is a file" $prohull build three.ply -o three.ply/hull.stl
says err "a folder that is a file" "three.ply is a file and no folder"
expect 2 "two meshes of one name" $prohull build parts/one.ply "$PWD/parts/../parts/one.ply" -o new/
says err "two meshes of one name" "is named twice"
absent new "two meshes of one name"
expect 2 "its own folder" $prohull build parts/one.ply -o parts/
expect 3 "a folder without meshes" $prohull build hulls/none -o new/
mkdir none
expect 3 "a folder without meshes" $prohull build none -o new/
says err "a folder without meshes" "no mesh file is in this folder"
absent new "a folder without meshes"

# Ctrl-C among several meshes: the first stays whole, and nothing else is said
$prohull sample knot --faces 300000 -o second.ply >/dev/null
$prohull build mesh.ply second.ply -o among/ --faces 60 --tight >out 2>err &
for wait in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15; do [ -e among/mesh.ply ] && break; sleep 1; done
kill -INT $!
wait $!
code=$?
is "Ctrl-C among meshes: exit code $code" test $code -eq 130
says err "Ctrl-C among meshes" "interrupted; only what was finished before is written"
is "Ctrl-C among meshes" test "$(ls -A among)" = mesh.ply
