# Regions of a mesh that a hull keeps, or stays near to

expect 0 "sample" $prohull sample bracket -o bracket.obj --faces 1500
cat >regions.yaml <<END
regions:
  - {name: slot, box: [[0, 0.6, 1.4], [0.5, 3.4, 2.6]], keep: true}
  - {name: upright, box: [[0, 0, 0.5], [0.5, 4, 3]], max_distance: 0.02}
END
expect 0 "regions" $prohull build bracket.obj --faces 600 --tolerance regions.yaml -o hull.obj --report hull.json
says out "regions: kept" "faces, kept: the hull has them with the same coordinates"
says out "regions: the distance" "from the hull, proven; 0.02 are allowed"
says hull.json "report: regions" '"kept": true'
says hull.json "report: the distance" '"distance_bound": 0.0'
expect 0 "regions: the hull encloses" $prohull verify hull.obj bracket.obj
expect 0 "regions, float32 that the samples have" $prohull build bracket.obj --faces 600 --tolerance regions.yaml -o hull.stl
cat >tight.yaml <<END
regions:
  - {name: all, box: [[-9, -9, -9], [9, 9, 9]], max_distance: 0.001}
END
for bound in "" "--max-void 50" "--max-distance 0.5"; do
  expect 1 "a target out of reach $bound" $prohull build bracket.obj --faces 12 --tolerance tight.yaml --strict $bound -o hull.obj
  says out "a target out of reach $bound" "no legal collapse is left above the 12 faces asked for"
  says_not out "a target out of reach $bound" "relaxed to reach it"
done
expect 0 "regions: inner" $prohull build bracket.obj --faces 600 --side inner --tolerance regions.yaml -o inner.obj
expect 0 "regions: all levels" $prohull build bracket.obj --faces 600 --tolerance regions.yaml -o a.obj --hierarchy a.phull
expect 0 "regions: recentered" $prohull build bracket.obj --faces 600 --tolerance regions.yaml --recenter -o a.obj
expect 0 "no regions" $prohull build bracket.obj --faces 600 -o without.obj --report without.json
checks=$((checks + 1))
grep -q region out without.json && fail "no word of regions where none were asked for"

# --- groups and colours ---
awk '/^f / && n++ == 100 { print "g lid" } n == 200 { print "g rest" } { print }' bracket.obj >groups.obj
echo '{"regions": [{"group": "lid", "keep": true}]}' >groups.json
expect 0 "a group, in JSON" $prohull build groups.obj --faces 600 --tolerance groups.json -o hull.obj
says out "a group, in JSON" "region 1 (lid): 99 faces, kept"
cat >painted.ply <<END
ply
format ascii 1.0
element vertex 4
property float x
property float y
property float z
property uchar red
property uchar green
property uchar blue
element face 4
property list uchar int vertex_indices
end_header
0 0 0 255 0 0
1 0 0 255 0 0
0 1 0 250 9 0
0 0 1 0 0 0
3 0 2 1
3 0 1 3
3 1 2 3
3 2 0 3
END
echo 'regions: [{color: "#ff0000", spread: 10, max_distance: 0.1}]' >painted.yaml
expect 0 "a colour" $prohull build painted.ply --faces 4 --tolerance painted.yaml -o hull.ply
says out "a colour" "1 face, at most "

# --- bounds that need no search ---
echo 'regions: [{box: [[-9, -9, -9], [9, 9, 9]], max_distance: 0.0001}]' >near.yaml
expect 0 "what is proven is kept" $prohull build bracket.obj --faces 100 --tolerance near.yaml -o hull.obj --report near.json
says out "what is proven is kept" " from the hull, proven; 0.0001 are allowed"
is "what is proven is kept" awk '/"regions"/ { inside = 1 } inside && /"distance_bound"/ { exit $2 + 0 > 0.0001 }' near.json

# --- what is refused ---
# refused EXIT_CODE NAME TEXT MESSAGE [OPTIONS...]: a file of regions with that text
refused() {
  code=$1 name=$2 text=$3 message=$4
  shift 4
  printf '%s\n' "$text" >bad.yaml
  expect "$code" "$name" $prohull build bracket.obj --faces 600 --tolerance bad.yaml -o none.obj "$@"
  says err "$name" "$message"
  absent none.obj "$name"
}
refused 3 "no YAML" 'regions: [' "bad.yaml: line"
refused 3 "no regions" 'region: 1' "expected a list of regions"
refused 3 "an unknown key" 'regions: [{boxes: 1, keep: true}]' "line 1: 'boxes' is not known"
refused 3 "two selectors" 'regions: [{group: a, faces: 1, keep: true}]' "has group and faces; make two regions"
refused 3 "no selector" 'regions: [{keep: true}]' "does not say which faces"
refused 3 "no distance" 'regions: [{faces: 1}]' "either 'keep: true' or a max_distance"
refused 3 "a distance with a unit" 'regions: [{faces: 1, max_distance: 5mm}]' "does not say its unit"
refused 3 "no distance: a word" 'regions: [{faces: 1, max_distance: near}]' "'near': expected a length"
refused 3 "an empty box" 'regions: [{box: [[0, 0, 0], [1, -1, 1]], keep: true}]' "least y is greater than its greatest y"
refused 2 "a box elsewhere" 'regions: [{box: [[7, 7, 7], [8, 8, 8]], keep: true}]' "bad.yaml: region 1: no face has all its corners"
refused 2 "an unknown group" 'regions: [{group: lid, keep: true}]' "no face has the group, object or material lid"
refused 2 "a region behind others" 'regions: [{faces: 0-99, keep: true}, {name: hole, faces: 3-9, max_distance: 1}]' "bad.yaml: region hole: the regions before it take all of its 7 faces"
refused 2 "a face beyond the last one" 'regions: [{faces: [3, 1490-1500], keep: true}]' "the mesh has no face 1500; its last one is 1495"
refused 2 "a vertex beyond the last one" 'regions: [{vertices: 0-9999, keep: true}]' "the mesh has no vertex 9999"
refused 2 "no colours" 'regions: [{color: "#ff0000", keep: true}]' "the mesh has none"
refused 3 "no colour" 'regions: [{color: red, keep: true}]' "'red' is not a color"
refused 3 "a wrong range" 'regions: [{faces: [9-3], keep: true}]' "'9-3': expected a number or a range"
refused 2 "more kept than asked for" 'regions: [{faces: 0-999, keep: true}]' "1000 faces are kept as they are"
refused 2 "wraps" 'regions: [{faces: 0-9, keep: true}]' "a wrap has none of the faces" --repair wrap
expect 2 "with --tight" $prohull build bracket.obj --tolerance regions.yaml --tight -o none.obj
says err "with --tight" "cannot be used together with"
expect 3 "a file that is not there" $prohull build bracket.obj --tolerance nowhere.yaml -o none.obj

# A third has no float32.
awk '/^v / { printf "v %.17g %.17g %.17g\n", $2 / 3, $3 / 3, $4 / 3; next } { print }' bracket.obj >third.obj
echo 'regions: [{faces: 0-99, keep: true}]' >numbers.yaml
expect 3 "kept faces that STL cannot hold" $prohull build third.obj --faces 600 --tolerance numbers.yaml -o none.stl
says err "kept faces that STL cannot hold" "write a .ply, .obj or .off file"
expect 0 "kept faces that OBJ holds" $prohull build third.obj --faces 600 --tolerance numbers.yaml -o third_hull.obj
