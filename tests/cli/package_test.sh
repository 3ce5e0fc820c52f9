# Makes packages with `prohull urdf --package`, moves them, and deletes what they were made of

# dae FILE IMAGE: a tetrahedron with an image
dae() {
  cat >"$1" <<DAE
<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset><unit name="meter" meter="1"/><up_axis>Z_UP</up_axis></asset>
  <library_images><image id="wood"><init_from>$2</init_from></image></library_images>
  <library_geometries><geometry id="g"><mesh>
    <source id="p"><float_array id="a" count="12">0 0 0 1 0 0 0 1 0 0 0 1</float_array>
      <technique_common><accessor source="#a" count="4" stride="3">
        <param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
      </accessor></technique_common></source>
    <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
    <triangles count="4"><input semantic="VERTEX" source="#v" offset="0"/><p>0 2 1 0 1 3 0 3 2 1 2 3</p></triangles>
  </mesh></geometry></library_geometries>
  <library_visual_scenes><visual_scene id="s"><node><instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
  <scene><instance_visual_scene url="#s"/></scene>
</COLLADA>
DAE
}

# obj FILE MATERIALS: a tetrahedron
obj() {
  printf 'mtllib %s\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nusemtl m\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n' "$2" >"$1"
}

# link NAME MESH
link() {
  echo "<link name=\"$1\"><visual><geometry><mesh filename=\"$2\"/></geometry></visual></link>"
  [ "$1" = base ] || echo "<joint name=\"to_$1\" type=\"fixed\"><parent link=\"base\"/><child link=\"$1\"/></joint>"
}

# --- a robot as they are in the wild: a package, another one beside it, blanks, letters, links, two of one name ---
mkdir -p ws/src/arm_description/urdf ws/src/arm_description/meshes/a ws/src/arm_description/meshes/b \
  ws/src/arm_description/textures ws/src/arm_description/config ws/src/tools/meshes ws/store
cd ws/src/arm_description || exit 1
echo '<package format="3"><name>arm_description</name></package>' >package.xml
echo '<package format="3"><name>tools</name></package>' >../tools/package.xml
printf 'wood of a' >textures/wood.png
printf 'wood of b' >meshes/b/wood.png
cp textures/wood.png "meshes/a/the same wood.png"
dae meshes/a/link.dae ../../textures/wood.png
dae "meshes/a/größe und weite.dae" the%20same%20wood.png
obj meshes/b/link.obj link.mtl
printf 'newmtl m\nKd 1 0 0\nmap_Kd -s 1 1 1 wood.png\nmap_Bump lost.png\n' >meshes/b/link.mtl
$prohull sample sphere --faces 80 -o meshes/a/link.stl >/dev/null
$prohull sample bracket --faces 200 -o meshes/a/shipped.stl >/dev/null
cp meshes/a/link.stl meshes/b/link.stl
$prohull sample box --faces 12 -o ../tools/meshes/link.stl >/dev/null
dae ../../store/linked.dae wood.png
ln -s ../../../../store/linked.dae meshes/b/linked.dae
printf 'rate: 1\n' >config/controllers.yaml
cat >urdf/arm.urdf <<URDF
<robot name="arm">
  <material name="wood"><texture filename="../textures/wood.png"/></material>
  $(link base ../meshes/a/link.dae)
  $(link size 'package://arm_description/meshes/a/größe%20und weite.dae')
  $(link obj package://arm_description/meshes/b/link.obj)
  $(link stl ../meshes/a/link.stl | sed 's|</visual>|&<collision><geometry><mesh filename="../meshes/a/shipped.stl"/></geometry></collision>|')
  $(link twin ../meshes/b/link.stl)
  $(link tool package://tools/meshes/link.stl)
  $(link linked ../meshes/b/linked.dae)
  <gazebo><plugin filename="libcontrol.so"><parameters>package://arm_description/config/controllers.yaml</parameters>
    <uri>model://nowhere/x.dae</uri><uri>arm.urdf</uri><other>package://gone/config/x.yaml</other></plugin></gazebo>
</robot>
URDF
cd ../../.. || exit 1
chmod -R a-w ws/src
small="--faces 50 --configurations 0 --no-pictures --no-cache"
arm="$prohull urdf ws/src/arm_description/urdf/arm.urdf"

expect 0 "a plan" $arm --package arm_safe --dry-run
says out "a plan says what is copied" "copies for the package: 10 files"
absent arm_safe "a plan writes nothing"
expect 2 "a plan knows what a package may be called" $arm --package "Arm" --dry-run
expect 0 "a package" $arm -o made/arm_safe --package arm_safe $small --certificate
says out "what is copied" "copies for the package: 10 files"
says out "URIs that are not found, and robots" "arm.urdf, lost.png of link.mtl, model://nowhere/x.dae, package://gone/config/x.yaml"
says made/arm_safe/package.xml "a package that is not here" "<exec_depend>gone</exec_depend>"
says_not made/arm_safe/package.xml "a package that was copied" "tools"
says made/arm_safe/arm.urdf "what is not found stays" "<other>package://gone/config/x.yaml</other>"
says made/arm_safe/arm.urdf "what is no mesh" "<parameters>package://arm_safe/files/controllers.yaml</parameters>"
says made/arm_safe/arm.urdf "textures of the robot" '<texture filename="package://arm_safe/meshes/visual/wood.png"/>'
is "the same bytes once, names distinct" test "$(cd made/arm_safe/meshes/visual && echo *)" = \
  "gr____e_und_weite.dae link.dae link.mtl link.obj link.stl link_2.stl linked.dae wood.png wood_2.png"
says made/arm_safe/meshes/visual/link.dae "a path becomes a name" "<init_from>wood.png</init_from>"
says made/arm_safe/meshes/visual/gr____e_und_weite.dae "an image of the same bytes" "<init_from>wood.png</init_from>"
says made/arm_safe/meshes/visual/linked.dae "an image beside a symbolic link" "<init_from>wood_2.png</init_from>"
says made/arm_safe/meshes/visual/link.mtl "options stay" "map_Kd -s 1 1 1 wood_2.png"
says made/arm_safe/report.json "the report lists copies" '"meshes/visual/link.obj"'
says made/arm_safe/report.json "certificates are about copies" '"original": "meshes/visual/link.stl"'

# --- the folder alone is the robot ---
mv made/arm_safe moved && rm -rf made && chmod -R u+w ws
mv ws elsewhere
mv moved arm_safe
expect 0 "it loads after it was moved" $prohull urdf arm_safe/arm.urdf --check --no-outside-files
says out "all links have their meshes" "yes: the collision geometry covers the visual geometry of every link"
is "no file names another place" sh -c '! grep -rlE "\.\./|elsewhere|ws/src" arm_safe --include=*.urdf --include=*.dae --include=*.obj --include=*.mtl'
if command -v colcon >/dev/null && /usr/bin/python3 -c "import colcon_ros, colcon_recursive_crawl" 2>/dev/null && [ -d /usr/share/ament_cmake ]; then
  mkdir -p colcon/src && cp -r arm_safe colcon/src
  expect 0 "colcon builds it" sh -c "cd colcon && colcon build --cmake-args -DPython3_EXECUTABLE=/usr/bin/python3"
  is "colcon installs it" test -s colcon/install/arm_safe/share/arm_safe/meshes/visual/wood_2.png
  expect 0 "it loads as installed" env AMENT_PREFIX_PATH="$PWD/colcon/install/arm_safe" \
    $prohull urdf colcon/install/arm_safe/share/arm_safe/arm.urdf --check
else
  echo "skipped: colcon's build needs ament-cmake, colcon, python3-colcon-ros and python3-colcon-recursive-crawl"
fi

# --- again into the same folder ---
rm -r arm_safe && mv elsewhere ws
expect 0 "again" $arm -o arm_safe --package arm_safe $small
expect 0 "nothing new" $arm -o arm_safe --package arm_safe $small
says out "nothing new" "up to date"
printf 'new wood' >ws/src/arm_description/textures/wood.png
echo mine >arm_safe/meshes/visual/mine.png
sed -i '/link name="tool"/d; /child link="tool"/d' ws/src/arm_description/urdf/arm.urdf
expect 0 "an image and the robot have changed" $arm -o arm_safe --package arm_safe $small
is "a changed image is copied again" grep -q "new wood" arm_safe/meshes/visual/wood.png
absent arm_safe/meshes/visual/link_2.stl "a copy that nothing names"
is "a file of the user stays" grep -q mine arm_safe/meshes/visual/mine.png
printf 'mine' >ws/src/arm_description/meshes/a/mine.png
sed -i 's|textures/wood|meshes/a/mine|' ws/src/arm_description/urdf/arm.urdf
expect 2 "a file of the user is not replaced" $arm -o arm_safe --package arm_safe $small
is "it is as it was" grep -q mine arm_safe/meshes/visual/mine.png

# --- strangers ---
mkdir stranger && printf 'secret' >secret.png && printf 'secret' >secret.mtl
obj stranger/a.obj ../secret.mtl
echo "<robot name=\"s\">$(link base a.obj)</robot>" >stranger/s.urdf
expect 3 "materials of a stranger" $prohull urdf stranger/s.urdf -o s --package s $small --no-outside-files
says err "materials of a stranger" "--no-outside-files refuses"
obj stranger/a.obj a.mtl
ln -s ../secret.mtl stranger/a.mtl
expect 3 "a symbolic link of a stranger" $prohull urdf stranger/s.urdf -o s --package s $small --no-outside-files
absent s "a stranger gets nothing"
rm stranger/a.mtl
printf 'map_Kd a.mtl\nmap_Kd a.obj\nmap_Kd /etc/passwd\nmap_Kd\n' >stranger/a.mtl
expect 0 "materials that name each other" $prohull urdf stranger/s.urdf -o s --package s $small
says out "what is no image" "/etc/passwd of a.mtl"
says s/meshes/visual/a.mtl "what is no image stays" "map_Kd /etc/passwd"
printf '<COLLADA><library_images><image><init_from>' >stranger/b.dae
sed -i 's|</robot>|<gazebo><uri>b.dae</uri></gazebo>&|' stranger/s.urdf
expect 0 "a file that is broken" $prohull urdf stranger/s.urdf -o s --package s $small
says out "a file that is broken" "what b.dae names"

# --- other ways to name a file ---
mkdir -p forms/sub && printf 'one' >"forms/two  words.png" && printf 'two' >forms/sub/wood.png
dae forms/new.dae '<ref>two%20%20words.png</ref>'
sed -i 's/version="1.4.1"/version="1.5.0"/' forms/new.dae
obj forms/two.obj "one file.mtl"
obj forms/three.obj "one.mtl   other.mtl"
printf 'newmtl m\nmap_Kd sub\\wood.png\n' >"forms/one file.mtl"
printf 'newmtl m\r\nMAP_KD -o 1 two  words.png \r\n' >forms/one.mtl
printf 'newmtl n\n  norm sub/wood.png' >forms/other.mtl
echo "<robot name=\"f\">$(link base new.dae)$(link two two.obj)$(link three three.obj)</robot>" >forms/f.urdf
expect 0 "other ways to name a file" $prohull urdf forms/f.urdf -o f --package f $small
says_not out "all files are found" "not copied"
says f/meshes/visual/new.dae "COLLADA 1.5" "<init_from><ref>two__words.png</ref></init_from>"
says f/meshes/visual/two.obj "a name with a blank" "mtllib one_file.mtl"
says f/meshes/visual/three.obj "two names" "mtllib one.mtl   other.mtl"
says f/meshes/visual/one_file.mtl "a path of Windows" "map_Kd wood.png"
is "an option, and the end of a line" grep -q "^MAP_KD -o 1 two__words.png .$" f/meshes/visual/one.mtl
says f/meshes/visual/other.mtl "the end of a file" "  norm wood.png"

# --- SDF, and glTF with a buffer and an image ---
mkdir gltf && printf 'blue' >"gltf/its image.png"
$prohull sample box --faces 12 -o gltf/box.glb >/dev/null
python3 - <<'PY'
import json, struct
data = open("gltf/box.glb", "rb").read()
size, = struct.unpack("<I", data[12:16])
scene = json.loads(data[20:20 + size])
open("gltf/my buffer.bin", "wb").write(data[28 + size:])
scene["images"] = [{"uri": "its%20image.png"}]
scene["textures"] = [{"source": 0}]
text = json.dumps(scene).encode()
text += b" " * (-len(text) % 4)
rest = data[20 + size:]
open("gltf/outer.glb", "wb").write(b"glTF" + struct.pack("<II", 2, 20 + len(text) + len(rest)) +
                                   struct.pack("<I", len(text)) + b"JSON" + text + rest)
scene["buffers"][0]["uri"] = "my%20buffer.bin"
json.dump(scene, open("gltf/box.gltf", "w"))
PY
cat >gltf/box.sdf <<'SDF'
<sdf version="1.9"><model name="box"><link name="a">
  <visual name="v"><geometry><mesh><uri>box.gltf</uri></mesh></geometry>
    <material><pbr><metal><albedo_map>its image.png</albedo_map></metal></pbr></material></visual>
</link><link name="b"><visual name="v"><geometry><mesh><uri>outer.glb</uri></mesh></geometry></visual></link>
<joint name="j" type="fixed"><parent>a</parent><child>b</child></joint></model></sdf>
SDF
expect 0 "SDF" $prohull urdf gltf/box.sdf -o box_safe --package box_safe $small
rm -r gltf
expect 0 "SDF alone" $prohull urdf box_safe/box.sdf --check
says box_safe/box.sdf "an image of SDF" "<albedo_map>package://box_safe/meshes/visual/its_image.png</albedo_map>"
says box_safe/meshes/visual/box.gltf "a buffer" '"my_buffer.bin"'
says box_safe/meshes/visual/outer.glb "an image of GLB" '"its_image.png"'

mkdir -p models/hand models/arm && printf 'skin' >models/hand/skin.png && dae models/hand/hand.dae skin.png
echo '<sdf version="1.9"><model name="hand"><link name="palm"><visual name="v"><geometry><mesh><uri>hand.dae</uri></mesh></geometry></visual></link></model></sdf>' >models/hand/model.sdf
echo '<sdf version="1.9"><model name="arm"><include><uri>model://hand</uri></include></model></sdf>' >models/arm/arm.sdf
expect 0 "SDF that includes" $prohull urdf models/arm/arm.sdf -o hand_safe --package hand_safe $small
rm -r models
is "what is included is copied" grep -q skin hand_safe/meshes/visual/skin.png
expect 0 "it stands alone" $prohull urdf hand_safe/arm.sdf --check --no-outside-files
