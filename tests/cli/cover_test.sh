# Drives `prohull verify --union` as a user would

# slab FILE FROM TO FIRST: a box [FROM, TO] x [0, 1] x [0, 1] as OBJ; FIRST is the number before its first vertex
slab() {
  for z in 0 1; do for y in 0 1; do for x in $2 $3; do echo "v $x $y $z"; done; done; done >>"$1"
  for face in "1 3 4 2" "5 6 8 7" "1 2 6 5" "3 7 8 4" "1 5 7 3" "2 4 8 6"; do
    set -- "$1" "$2" "$3" "$4" $face
    echo "f $(($4 + $5)) $(($4 + $6)) $(($4 + $7)) $(($4 + $8))"
  done >>"$1"
}
slab part.obj 0 1 0
slab left.obj 0 0.3 0
slab right.obj 0.3 1 0
slab away.obj 0.30000000000000004 1 0
slab both.obj 0 0.3 0
slab both.obj 0.3 1 8

# --- pieces ---
expect 0 "several files" $prohull verify --union left.obj right.obj part.obj --report report.json
says out "several files" "yes: the union of 2 pieces encloses part.obj, exactly"
says report.json "report: the verdict" '"certified": true'
says report.json "report: the pieces" '"pieces": 2'
says report.json "report: the reach" '"upper"'
expect 0 "one file of two components" $prohull verify --union both.obj part.obj
says out "one file of two components" "the union of 2 pieces encloses"
expect 0 "files mixed" $prohull verify --union both.obj left.obj part.obj
says out "files mixed" "the union of 3 pieces encloses"
expect 1 "a slit of one ulp" $prohull verify --union left.obj away.obj part.obj --report report.json
says out "a slit of one ulp" "NO: the union of 2 pieces does not enclose"
says out "a slit of one ulp: offenders" "8 faces of part.obj lie outside"
says report.json "report: offenders" '"point"'
expect 1 "one piece alone" $prohull verify --union left.obj part.obj
says out "one piece alone" "NO: the union of 1 piece does not enclose"
expect 0 "the solid alone" $prohull verify --union both.obj part.obj --solid-only
says out "the solid alone" "the solid of part.obj"
sed '$d' left.obj >open.obj
expect 3 "a piece that is not closed" $prohull verify --union right.obj open.obj part.obj
says err "a piece that is not closed" "piece 2: the piece's mesh is not closed"
expect 0 "an original that is not closed" $prohull verify --union right.obj left.obj open.obj
says out "an original that is not closed" "every triangle of open.obj"

# --- spheres ---
cat >spheres.yaml <<'YAML'
collision_spheres:
  part:
    - center: [0.5, 0.5, 0.5]
      radius: 0.9
YAML
expect 0 "spheres" $prohull verify --union spheres.yaml part.obj --inside --report report.json
says out "spheres" "yes: the union of 1 sphere encloses part.obj, exactly"
says report.json "report: the spheres" '"spheres": 1'
expect 0 "the surface alone" $prohull verify --union spheres.yaml part.obj
says out "the surface alone" "covers every triangle of part.obj"
sed 's/0.9/0.8/' spheres.yaml >small.yaml
expect 1 "spheres that are too small" $prohull verify --union small.yaml part.obj
says out "spheres that are too small" "outside"

# --- what `prohull convex` and `prohull spheres` write ---
$prohull sample bracket --faces 300 -o bracket.stl >/dev/null
for suffix in urdf xml; do
  for shape in polytope box sphere; do
    expect 0 "$suffix of shape $shape" $prohull convex bracket.stl --pieces 3 --vertices 24 --shape $shape -o c.$suffix
    expect 0 "$suffix of shape $shape covers" $prohull verify --union c.$suffix bracket.stl --report report.json
    says out "$suffix of shape $shape covers" "bracket.stl, exactly"
  done
done
says report.json "spheres of a robot" '"pieces": 0'
expect 0 "boxes" $prohull convex bracket.stl --pieces 3 --shape box -o boxes.urdf
expect 0 "turned boxes count as smaller" $prohull verify --union boxes.urdf bracket.stl
says out "turned boxes count as smaller" "boxes.urdf: boxes whose corners have no exact coordinates"
for suffix in yaml urdf xml json; do
  expect 0 "spheres as $suffix" $prohull spheres bracket.stl --count 10 --fill -o s.$suffix
  expect 0 "spheres as $suffix cover" $prohull verify --union s.$suffix bracket.stl --inside
  says out "spheres as $suffix cover" "encloses bracket.stl"
done
sed 's/radius="[^"]*"/radius="0.01"/' s.urdf >less.urdf
expect 1 "spheres of a robot that are too small" $prohull verify --union less.urdf bracket.stl
cat >unit.urdf <<'XML'
<robot name="r"><link name="a"><collision><origin xyz="0.5 0.5 0.5"/><geometry><box size="1 1 1"/></geometry></collision></link>
<link name="b"><collision><geometry><box size="1 1 1"/></geometry></collision></link><link name="c"/>
<joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint>
<joint name="k" type="fixed"><parent link="a"/><child link="c"/></joint></robot>
XML
expect 0 "a box as large as the part" $prohull verify --union unit.urdf part.obj --link a --report report.json
says report.json "the link in the report" '"link": "a"'
expect 1 "the box of another link" $prohull verify --union unit.urdf part.obj --link b
expect 2 "several links" $prohull verify --union unit.urdf part.obj
says err "several links" "unit.urdf: pieces of which link? it has a, b; say --link NAME"
expect 2 "a link without pieces" $prohull verify --union unit.urdf part.obj --link c
says err "a link without pieces" "no link 'c' has pieces; it has a, b"
sed 's/<box size="1 1 1"/<cylinder radius="1" length="2"/' unit.urdf >cylinder.urdf
expect 2 "a cylinder" $prohull verify --union cylinder.urdf part.obj --link a
says err "a cylinder" "cylinder.urdf: line 1: cylinders and capsules are not decided exactly"
echo '<robot name="r"><link name="a"/></robot>' >bare.urdf
expect 3 "a robot without pieces" $prohull verify --union bare.urdf part.obj
says err "a robot without pieces" "bare.urdf: no link has any pieces"
cat >mesh.urdf <<'XML'
<robot name="r"><link name="a"><collision><origin xyz="0.5 0 0" rpy="0 0 1"/><geometry><mesh filename="part.obj"/></geometry>
</collision></link></robot>
XML
expect 2 "a mesh that is turned" $prohull verify --union mesh.urdf part.obj
says err "a mesh that is turned" "mesh.urdf: line 1: the origin of part.obj rounds its coordinates"
sed 's/ rpy="0 0 1"//' mesh.urdf >moved.urdf
expect 1 "a mesh that is moved" $prohull verify --union moved.urdf part.obj
sed 's/part.obj/nowhere.obj/' mesh.urdf >missing.urdf
expect 3 "a mesh that is missing" $prohull verify --union missing.urdf part.obj
says err "a mesh that is missing" "nowhere.obj"
echo '{"link": "a", "spheres": [{"center": [0, 0], "radius": 1}]}' >wrong.json
expect 3 "a sphere without a center" $prohull verify --union wrong.json part.obj
says err "a sphere without a center" "wrong.json: expected spheres as"
echo '{"spheres": []}' >none.json
expect 3 "no spheres" $prohull verify --union none.json part.obj
says err "no spheres" "neither pieces nor spheres"

# --- spheres of several links ---
cat >links.yaml <<'YAML'
collision_spheres:
  part:
    - {center: [0.5, 0.5, 0.5], radius: 0.9}
    - {center: [0.5, 0.5, 0.5], radius: -1.0}
    - {center: [0.5, 0.5, 0.5], radius: -10.0}
  other:
    - {center: [0.5, 0.5, 0.5], radius: 0.1}
YAML
expect 2 "spheres of several links" $prohull verify --union links.yaml part.obj
says err "spheres of several links" "it has part, other; say --link NAME"
expect 0 "spheres of one of several links" $prohull verify --union links.yaml part.obj --link part --report report.json
says out "negative radii" "links.yaml: 2 spheres of a radius of 0 or less left out"
says report.json "negative radii in the report" "2 spheres of a radius of 0 or less left out"
expect 1 "spheres of the other link" $prohull verify --union links.yaml part.obj --link other

# --- wrong usage ---
expect 2 "a link of mesh files" $prohull verify --union both.obj part.obj --link part
says err "a link of mesh files" "--link picks a link"
expect 2 "a link without --union" $prohull verify both.obj part.obj --link part
expect 2 "spheres and meshes" $prohull verify --union spheres.yaml left.obj part.obj
says err "spheres and meshes" "both spheres and meshes"
expect 2 "several files without --union" $prohull verify left.obj right.obj part.obj
says err "several files without --union" "with --union the last one is ORIGINAL"
expect 2 "--inside without --union" $prohull verify both.obj part.obj --inside
expect 2 "--union and --side" $prohull verify --union both.obj part.obj --side inner
expect 2 "--union with one file" $prohull verify --union part.obj
expect 0 "help" $prohull verify --help
says out "help" "--union"
