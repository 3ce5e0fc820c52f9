# Drives `prohull spheres` as a user would
$prohull sample bracket --faces 600 -o bracket.stl >/dev/null
spheres="$prohull spheres bracket.stl --count 20"

# --- the main job ---
expect 0 "YAML" $spheres -o bracket.yaml --report report.json
says out "YAML" "certified: yes, the union of the spheres as written covers every triangle of the original"
says out "YAML: how far" "% of the diagonal"
says bracket.yaml "YAML: cuRobo's key" "collision_spheres:"
says bracket.yaml "YAML: the link is called as the file" '"bracket":'
is "YAML: at most 20 spheres" test "$(grep -c radius bracket.yaml)" -le 20
says report.json "report" '"certified": true'
says report.json "report: bounds" '"within_bounds": true'
expect 0 "filled" $spheres -o filled.yml --fill --link "arm/1"
says out "filled" "encloses the original"
says filled.yml "filled: the link" '"arm/1":'
expect 0 "URDF" $spheres -o bracket.urdf
says bracket.urdf "URDF" "<sphere radius="
expect 0 "MJCF" $spheres -o bracket.xml
says bracket.xml "MJCF" 'type="sphere"'
expect 0 "JSON" $spheres -o bracket.json
says bracket.json "JSON" '"radius"'
for format in json urdf xml; do
  expect 0 "$format: what is certified is what was written" $spheres -o again.$format --link "arm 1"
  says out "$format: what is certified is what was written" "certified: yes, the union of the spheres as written covers every"
  expect 0 "$format: verify reads it" $prohull verify --union again.$format bracket.stl --link "arm 1"
  expect 0 "$format: on standard output" $spheres -o - --out-format $format --link "arm 1"
  is "$format: standard output has the same bytes" cmp out again.$format
done
expect 0 "standard output" $spheres -o - --out-format yaml
is "standard output has the same bytes" cmp out bracket.yaml
says err "the summary goes to standard error then" "certified: yes"
expect 0 "standard input" $prohull spheres - --count 20 -o - --out-format yaml -q <bracket.stl
says out "standard input: the link" '"link":'
is "-q says nothing" test ! -s err
expect 0 "one thread" $spheres -o one.yaml --link bracket --threads 1
is "one thread finds the same spheres" cmp one.yaml bracket.yaml
expect 0 "a unit" $prohull spheres bracket.stl --count 1 --unit mm -o mm.json
expect 0 "no unit" $prohull spheres bracket.stl --count 1 -o whole.json
is "a unit makes metres" test "$(grep radius mm.json)" != "$(grep radius whole.json)"
expect 0 "a distance" $prohull spheres bracket.stl --max-distance 0.4 -o near.yaml --report near.json
says near.json "a distance is kept" '"within_bounds": true'

printf 'OFF\n5 5 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\nnan 0 0\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n3 0 1 4\n' >nan.off
expect 0 "a corner that is no number" $prohull spheres nan.off --count 4 -o nan.yaml
says out "a corner that is no number" "around 4 faces"
says out "a corner that is no number" "triangles with corners that are not finite were left out: 1"

# --- the answer no ---
expect 1 "a distance that takes more spheres" $spheres --max-distance 0.001 -o far.yaml
says out "a distance that takes more spheres" "--max-distance 0.001 is not kept"
is "the spheres are written nevertheless" test -s far.yaml

# --- what is refused, and leaves nothing ---
expect 2 "no output" $prohull spheres bracket.stl
says err "no output" "--out"
expect 2 "a mesh format" $spheres -o none.stl
says err "a mesh format" "spheres are not written to .stl files; name the file .yaml"
expect 2 "no format" $spheres -o -
expect 2 "no spheres" $prohull spheres bracket.stl --count 0 -o none.yaml
says err "no spheres" "--count must be between 1 and 100,000"
printf 'OFF\n0 0 0\n' >empty.off
expect 3 "a share of nothing" $prohull spheres empty.off --max-distance 1% -o none.yaml
expect 2 "a negative distance" $spheres --max-distance -1 -o none.yaml
expect 2 "a distance that is no number" $spheres --max-distance nan -o none.yaml
expect 2 "the input as output" $prohull spheres bracket.stl -o none.yaml --report bracket.stl
expect 2 "one file twice" $spheres -o none.yaml --report none.yaml
expect 3 "no such file" $prohull spheres nowhere.stl -o none.yaml
says err "no such file" "nowhere.stl"
head -c 700 bracket.stl >cut.stl
expect 3 "a file that was cut off" $prohull spheres cut.stl -o none.yaml
printf 'solid empty\nendsolid empty\n' >empty.stl
expect 3 "no triangle" $prohull spheres empty.stl -o none.yaml
says err "no triangle" "empty.stl"
expect 3 "no folder" $spheres -o nowhere/none.yaml
mkdir closed && chmod 555 closed
if [ ! -w closed ]; then
  expect 3 "a folder that takes no files" $spheres -o closed/none.yaml
fi
absent "none.* .none* closed/*" "what is refused leaves nothing"

# --- hostile names ---
name='a: [b] "c" #<&d>
e.stl'
cp bracket.stl "$name"
expect 0 "a hostile name in YAML" $prohull spheres "$name" --count 5 -o hostile.yaml
says hostile.yaml "a hostile name in YAML" '"a: [b] \"c\" #<&d>\ne":'
expect 0 "a hostile name in XML" $spheres --link 'a"<&>b' -o hostile.urdf
says hostile.urdf "a hostile name in XML" '&lt;&amp;'
latin=$(printf 'a\377')
for suffix in yaml json urdf xml; do
  expect 2 "a name that is not UTF-8 in $suffix" $spheres --link "$latin" -o none.$suffix
done
absent "none.*" "a name that is not UTF-8"

# --- dirty input ---
printf 'solid s
facet normal 0 0 0 outer loop vertex 0 0 0 vertex 1 0 0 vertex 1 1 0 endloop endfacet
facet normal 0 0 0 outer loop vertex 0 0 0 vertex nan 0 0 vertex 1 1 0 endloop endfacet
endsolid s\n' >sheet.stl
expect 0 "a sheet" $prohull spheres sheet.stl --count 10 -o sheet.yaml
says out "a sheet" "certified: yes"

# --- Ctrl-C, and a kill ---
$prohull sample knot --faces 200000 -o knot.ply >/dev/null
for signal in INT TERM; do
  $prohull spheres knot.ply --count 3000 -o interrupted.yaml >out 2>err &
  sleep 0.5
  kill -$signal $!
  wait $!
  code=$?
  is "SIG$signal: exit code $code" test $code -ge 130
  absent "interrupted* .interrupted*" "SIG$signal"
done
