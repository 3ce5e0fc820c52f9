# Drives `prohull urdf` as a user would
# --- a robot of three links, the collision mesh of which is too small for the first ---
mkdir -p robot/meshes
$prohull sample bracket --faces 600 -o robot/meshes/bracket.stl >/dev/null
$prohull sample bracket --faces 200 -o robot/meshes/coarse.stl >/dev/null
$prohull sample knot --faces 600 -o robot/meshes/knot.ply >/dev/null
cat >robot/robot.urdf <<'URDF'
<?xml version="1.0"?>
<!-- a <robot> for tests -->
<robot name="three">
	<link name="base">
		<visual><geometry><mesh filename="meshes/bracket.stl" scale="0.1 0.1 0.1"/></geometry></visual>
		<collision><geometry><mesh filename="meshes/bracket.stl" scale="0.09 0.1 0.1"/></geometry></collision>
	</link>
	<link name="arm/&lt;1&gt;">
		<visual>
			<origin xyz="0 0 0.1" rpy="0.1 0.2 0.3"/>
			<geometry><mesh filename="meshes/knot.ply" scale="0.1 0.1 0.1"/></geometry>
		</visual>
	</link>
	<link name="wheel">
		<visual><geometry><cylinder radius="0.1" length="0.05"/></geometry></visual>
		<collision><geometry><cylinder radius="0.1" length="0.05"/></geometry></collision>
	</link>
	<joint name="lift" type="prismatic">
		<parent link="base"/><child link="arm/&lt;1&gt;"/><axis xyz="0 0 1"/>
		<limit lower="0" upper="0.5" effort="1" velocity="1"/>
	</joint>
	<joint name="turn" type="continuous"><parent link="arm/&lt;1&gt;"/><child link="wheel"/></joint>
	<unknown tag="kept"/>
</robot>
URDF
cp -r robot before
urdf="$prohull urdf robot/robot.urdf"

# --- what it ships with ---
expect 1 "check" $urdf --check --junit junit.xml --report check.json
says out "check: a leak" "LEAKS"
says out "check: what to do" "prohull urdf robot/robot.urdf -o DIR"
says junit.xml "check: JUnit" "<failure"
says check.json "check: JSON" '"verdict": "leaks"'
expect 1 "check with too little allowed" $urdf --check --allow 0.01mm
cp -r robot "a robot's"
expect 1 "a name that a shell would take apart" $prohull urdf "a robot's/robot.urdf" --check
says out "a name that a shell would take apart" "\`prohull urdf 'a robot'\\''s/robot.urdf' -o DIR\`"
rm "a robot's/meshes/knot.ply"
expect 1 "check without a mesh" $prohull urdf "a robot's/robot.urdf" --check
says_not out "check without a mesh: no run that would fail" "-o DIR"

# a model that is named without a folder, and includes another one
mkdir -p included/inner
cat >included/inner/model.sdf <<'SDF'
<sdf version="1.9"><model name="inner"><link name="l">
<visual name="v"><geometry><mesh><uri>part.stl</uri></mesh></geometry></visual>
<collision name="c"><geometry><mesh><uri>part.stl</uri><submesh><name>s</name></submesh></mesh></geometry></collision>
</link></model></sdf>
SDF
cp robot/meshes/bracket.stl included/inner/part.stl
cat >included/top.sdf <<'SDF'
<sdf version="1.9"><model name="m"><link name="l"/><include><uri>inner</uri><name>a</name></include></model></sdf>
SDF
(cd included && $prohull urdf top.sdf --check >out 2>err)
is "a file without a folder" test $? -eq 1
says included/out "what a submesh covers is not known" "the submesh of link 'a::l' is not read"
says included/out "what a submesh covers is not known: verdict" "NOT CHECKED"
expect 2 "--allow without --check" $urdf --allow 1mm -o none
expect 2 "--allow is a length" $urdf --check --allow 1lb
says err "--allow is a length" "'1lb' is no length"

cat >robot.srdf <<'SRDF'
<robot name="three">
  <disable_collisions link1="base" link2="wheel" reason="Never"/>
  <disable_collisions link1="base" link2="head" reason="Never"/>
  <disable_collisions link1="base" link2="arm/&lt;1&gt;" reason="Adjacent"/>
</robot>
SRDF
expect 1 "an SRDF that ships" $urdf --check --allow 1m --srdf robot.srdf --junit rows.xml --report rows.json
says out "a refuted row" 'line 2, base and wheel, "Never": REFUTED: the collision geometry meets at lift '
says out "a row of a link that is not there" 'line 3, base and head, "Never": names no two links of the robot'
says out "rows are counted" "robot.srdf: 3 disabled pairs: 1 adjacent, 0 never meet, 0 always, 1 meet, 0 open; 1 REFUTED"
sed '/<collision><geometry><cylinder/d' robot/robot.urdf >robot/bare.urdf
expect 1 "a row of a link that nothing covers" $prohull urdf robot/bare.urdf --check --srdf robot.srdf
says out "a row of a link that nothing covers" 'line 2, base and wheel, "Never": REFUTED: the collision geometry is missing for one of the two; the visual geometry meets'
says out "a row of a link that nothing covers" "1 adjacent, 0 never meet, 0 always, 1 meet, 0 open; 1 REFUTED"
rm robot/bare.urdf
says rows.xml "rows in JUnit" "three: disabled pairs"
says rows.json "rows in JSON" '"disabled_pairs"'
sed 's/name="three"/name="four"/' robot.srdf >four.srdf
expect 1 "an SRDF with another name" $urdf --check --allow 1m --srdf four.srdf --report four.json --html four.html
for file in out four.json; do
  says $file "an SRDF with another name" "four.srdf: it is of the robot 'four', not of 'three'"
done
says four.html "an SRDF with another name" "About the SRDF file"
sed -i 's/"base"/"torso"/' four.srdf
expect 3 "an SRDF of another robot" $urdf --check --allow 1m --srdf four.srdf
says err "an SRDF of another robot" "four.srdf: line 1: no row of it names two links of this robot: it is of the robot 'four', not of 'three'; name the SRDF file of this robot"
expect 3 "a URDF for an SRDF" $urdf --check --allow 1m --srdf robot/robot.urdf
says err "a URDF for an SRDF" "it has no element of an SRDF file, as <disable_collisions>; name the SRDF file of the robot"
echo '<robot name="three"/>' >none.srdf
expect 1 "an SRDF that disables nothing" $urdf --check --allow 1m --srdf none.srdf
says out "an SRDF that disables nothing" "none.srdf: 0 disabled pairs"
expect 2 "--srdf without --check" $urdf --srdf robot.srdf -o none
expect 3 "an SRDF that is not there" $urdf --check --srdf nowhere.srdf

# --- the main job ---
small="--faces 200,60 --configurations 20 --no-pictures"
expect 0 "dry run" $urdf -o made $small --dry-run
says out "dry run" "a hull of 200 and 60 faces"
absent made "dry run"
expect 0 "build" $urdf -o made/deep $small
says out "build" "4 of 4 hulls are certified"
says out "build: motion" "20 configurations"
is "build leaves the input alone" diff -r robot before
for file in robot.urdf robot_60.urdf robot.srdf report.html report.json meshes/collision/base.stl \
  meshes/collision_60/arm__1_.stl; do
  is "build writes $file" test -s made/deep/$file
done
says made/deep/robot.urdf "untouched bytes stay" '<!-- a <robot> for tests -->'
says made/deep/robot.urdf "untouched bytes stay" '<unknown tag="kept"/>'
says made/deep/robot.urdf "the origin is copied" '<origin xyz="0 0 0.1" rpy="0.1 0.2 0.3"/>'
says made/deep/report.html "texts are shown, not interpreted" 'arm/&lt;1&gt;'
expect 0 "a robot with hulls passes the check" $prohull urdf made/deep/robot.urdf --check
says out "a robot with hulls passes the check" "yes: the collision geometry covers"
expect 0 "the coarse one too" $prohull urdf made/deep/robot_60.urdf --check
absent "made/deep/.[a-z]* made/deep/meshes/*/.[a-z]*" "unfinished files"

is "the SRDF has no sampled pairs" test -z "$(grep sampled made/deep/robot.srdf)"
says made/deep/report.json "pairs are decided" '"proven_free"'
says made/deep/robot.srdf "the SRDF has adjacent pairs" 'reason="Adjacent"'
expect 0 "sampled pairs, in a folder with a slash" $urdf -o sampled/ $small --sampled-pairs
says sampled/robot.srdf "sampled pairs are called so" "it is no proof"
expect 2 "sampled pairs without configurations" $urdf -o none --configurations 0 --sampled-pairs
expect 0 "a second run" $urdf -o made/deep $small
says out "a second run" "up to date"
expect 0 "without the coarse set" $urdf -o made/deep --faces 200 --configurations 20 --no-pictures
absent "made/deep/robot_60.urdf made/deep/meshes/collision_60" "files of an earlier run"
expect 0 "with the coarse set again" $urdf -o made/deep $small
mv made/deep made/deeper
expect 0 "a moved folder" $urdf -o made/deeper $small
says made/deeper/report.json "a moved folder is made again" '"from_cache": true'
mv made/deeper made/deep
expect 0 "the folder is back" $urdf -o made/deep $small
if strace -o /dev/null true 2>/dev/null; then  # kills a run while its files appear
  killed="strace -f -o /dev/null -e trace=rename -e inject=rename:signal=KILL:when"
  for renames in 2 3 4 5 6 7 8; do
    rm -rf killed && $killed=$renames $urdf -o killed --faces 100 --configurations 0 --no-pictures --no-cache >/dev/null 2>&1
    if [ -n "$(find killed -type f ! -name '.*')" ]; then
      expect 0 "after a run that was killed, $renames" $urdf -o killed --faces 100 --configurations 0 --no-pictures
    fi
  done
fi
echo '{"run": 3}' >made/deep/report.json
expect 2 "a damaged report.json" $urdf -o made/deep $small
says err "a damaged report.json" "choose a new folder"
rm -r made/deep
expect 0 "made once more" $urdf -o made/deep $small
# report.json names files of others, with the right fingerprints
mkdir victim && cp made/deep/meshes/collision/base.stl victim/base.stl
cp -r made/deep forged
sed -i 's|"meshes/collision/base.stl": "|"../victim/base.stl": "|' forged/report.json
expect 2 "a report that names files elsewhere" $urdf -o forged --faces 100 --configurations 0 --no-pictures
says err "a report that names files elsewhere" "choose a new folder"
is "files elsewhere stay" test -s victim/base.stl
sed "s|\"[.][.]/victim|\"$PWD/victim|" forged/report.json >absolute.json && mv absolute.json forged/report.json
expect 2 "a report with an absolute path" $urdf -o forged --faces 100 --configurations 0 --no-pictures
is "a file with an absolute path stays" test -s victim/base.stl
rm -r forged && cp -r made/deep forged && mv forged/meshes elsewhere && ln -s ../elsewhere forged/meshes
expect 2 "a link that leads out of the folder" $urdf -o forged --faces 100 --configurations 0 --no-pictures
is "files behind a link stay" cmp elsewhere/collision/base.stl made/deep/meshes/collision/base.stl
sed 's/"exit_code": 0/"exit_code": 77/' made/deep/report.json >odd.json && cp odd.json made/deep/report.json
expect 2 "an exit code that no run has" $urdf -o made/deep $small
rm -r made/deep
expect 0 "made again" $urdf -o made/deep $small
echo '<robot name="r"><link name="a"><visual><geometry><box size="1 1 1"/></geometry></visual></link></robot>' >box.urdf
expect 0 "a robot of one box" $prohull urdf box.urdf -o box --configurations 0 --no-pictures
sed 's/name="r"/name="other"/' box.urdf >other.urdf
expect 2 "a folder of another robot" $prohull urdf other.urdf -o box --configurations 0 --no-pictures
says err "a folder of another robot" "box: an earlier run has written the robot 'r' to it, whose files would be removed; choose another folder, or remove this one"
is "its files stay" test -s box/box.urdf
crashes=0
for seed in $(seq 60); do
  awk -v seed="$seed" 'BEGIN { srand(seed) }
    { n = length($0); i = 1 + int(rand() * n)
      if (rand() < 0.2) $0 = substr($0, 1, i - 1) substr("[]{}\"-9,:x", 1 + int(rand() * 10), 1) substr($0, i + 1)
      if (rand() < 0.05) print $0
      if (rand() > 0.03) print $0 }' box/report.json >mutant.json
  rm -rf mutant && cp -r box mutant && cp mutant.json mutant/report.json
  $prohull urdf box.urdf -o mutant --configurations 0 --no-pictures >out 2>err
  test $? -le 3 || crashes=$((crashes + 1))
done
is "no mutant of report.json is a crash" test $crashes -eq 0
rm made/deep/meshes/collision/base.stl
expect 0 "a lost file" $urdf -o made/deep $small
is "a lost file comes again" test -s made/deep/meshes/collision/base.stl
says made/deep/report.json "its hull comes from the cache" '"from_cache": true'
expect 0 "one thread" $urdf -o one $small --no-cache --threads 1
is "one thread makes the same hulls" diff -r one/meshes made/deep/meshes
expect 0 "OBJ and a package" $urdf -o three_safe $small --format obj --package three_safe
says three_safe/robot.urdf "a package" 'package://three_safe/meshes/collision/base.obj'
says three_safe/report.json "OBJ has the float32 hulls of STL" '"from_cache": true'
says out "a package" "copies for the package: 2 files"
expect 0 "a package is found" $prohull urdf three_safe/robot.urdf --check

expect 0 "MJCF" $urdf -o mujoco $small --to mjcf
for file in robot.urdf robot.xml robot_60.xml meshes/visual/knot.obj; do
  is "MJCF: $file" test -s mujoco/$file
done
says mujoco/robot.xml "MJCF: pairs without contacts" '<exclude body1="base" body2="arm/&lt;1&gt;"/>'
says mujoco/robot_60.xml "MJCF: its own hulls" 'file="meshes/collision_60/base.stl"'
says out "MJCF: the summary" "robot.xml: the robot for MuJoCo"
says out "MJCF: convex hulls" "MuJoCo collides with the convex hull of a mesh: "
expect 0 "MJCF has the robot and its hulls, exactly" $prohull urdf mujoco/robot.xml --check
expect 0 "MJCF again" $urdf -o mujoco $small --to mjcf
says out "MJCF again" "up to date"
expect 0 "without MJCF" $urdf -o mujoco $small
absent "mujoco/robot.xml mujoco/meshes/visual" "MJCF of an earlier run"
expect 0 "MJCF, dry" $urdf --to mjcf --dry-run
says out "MJCF, dry" "not in it: <unknown>, effort limits, velocity limits"
expect 2 "MJCF of GLB files" $urdf -o none --to mjcf --format glb
expect 2 "MJCF of a package" $urdf -o none --to mjcf --package none
expect 2 "MJCF of more faces than MuJoCo reads" $urdf -o none --to mjcf --faces 200001
expect 2 "another format" $urdf -o none --to sdf
says err "another format" "mjcf"

expect 0 "budgets to begin with" $urdf --write-budgets budgets.yaml --faces 150
sed -i 's/"base": .*/"base": {faces: [80], gap: 2mm}/' budgets.yaml
expect 0 "budgets" $urdf -o budgeted --budgets budgets.yaml --faces 150 --configurations 0 --no-pictures
says budgeted/report.json "budgets: faces" '"target_faces": 80'
says budgeted/report.json "budgets: gap" '"proof": "padding"'
absent budgeted/robot.srdf "without configurations"

# --- convex pieces and spheres ---
few="--configurations 20 --no-pictures"
expect 0 "dry run of pieces" $urdf -o pieces --collision convex --pieces 3 --dry-run
says out "dry run of pieces" "up to 3 convex pieces of up to 64 vertices"
expect 0 "convex pieces" $urdf -o pieces --collision convex --pieces 3 --vertices 16 $few
says out "convex pieces" "2 of 2 links are certified"
says out "convex pieces" "none missed"
is "convex pieces are files" test -s pieces/meshes/collision/base_01.stl
says pieces/report.json "convex pieces in JSON" '"collision": "convex"'
expect 0 "convex pieces pass the check" $prohull urdf pieces/robot.urdf --check
says out "convex pieces pass the check" "yes: the collision geometry covers"
expect 0 "convex pieces again" $urdf -o pieces --collision convex --pieces 3 --vertices 16 $few
says out "convex pieces again" "up to date"
expect 0 "spheres" $urdf -o balls --collision spheres --spheres 12 $few
says out "spheres" "3 of 3 links are certified"
says out "spheres" "none missed"
says balls/robot_spheres.yaml "spheres in a file of their own" "collision_spheres:"
says balls/robot.urdf "spheres in the robot" "<sphere radius="
absent balls/meshes "spheres need no meshes"
expect 0 "spheres pass the check" $prohull urdf balls/robot.urdf --check
says out "spheres pass the check" "yes: the collision geometry covers"
expect 2 "--pieces without convex pieces" $urdf -o none --pieces 3
says err "--pieces without convex pieces" "--pieces needs --collision convex"
expect 2 "a gap of pieces" $urdf -o none --collision convex --gap 1mm
says err "a gap of pieces" "takes no gap"
printf 'links:\n  base: {collision: spheres, faces: [20]}\n' >unheeded.yaml
expect 3 "faces of spheres" $urdf -o none --budgets unheeded.yaml
says err "faces of spheres" "unheeded.yaml: line 2: faces is for collision: hull; leave it out, or say so"
expect 2 "--tight without hulls" $urdf -o none --collision spheres --tight
expect 2 "two sets of spheres" $urdf -o none --collision spheres --faces 200,60
printf 'default: {faces: [100]}\nlinks:\n  base: {collision: convex, pieces: 2}\n' >mixed.yaml
expect 0 "mixed budgets" $urdf -o mixed --budgets mixed.yaml $few
says out "mixed budgets" "certified"
is "mixed budgets: pieces" test -s mixed/meshes/collision/base_01.stl
is "mixed budgets: a hull" test -s mixed/meshes/collision/arm__1_.stl

# --- what is refused, and leaves nothing ---
expect 2 "no folder" $urdf
says err "no folder" "-o"
expect 2 "the robot's own folder" $urdf -o robot
says err "the robot's own folder" "could be overwritten"
expect 2 "a folder with meshes" $urdf -o robot/meshes
is "what is refused leaves the input alone" diff -r robot before
expect 2 "--check with -o" $urdf --check -o none
expect 2 "--dry-run with --write-budgets" $urdf --dry-run --write-budgets budgets2.yaml
sed 's/<cylinder radius="0.1" length="0.05"/<ellipsoid size="1 1 1"/' robot/robot.urdf >robot/ellipsoid.urdf
expect 1 "a shape that is not read" $prohull urdf robot/ellipsoid.urdf -o ellipsoid $small
says out "a shape that is not read" "wheel: left as it is: its geometry of type ellipsoid is not read"
says ellipsoid/ellipsoid.urdf "a shape that is not read stays" '<collision><geometry><ellipsoid'
rm robot/ellipsoid.urdf
expect 0 "a distance" $urdf -o near --faces 20 --max-distance 0.1mm --configurations 0 --no-pictures
says near/report.json "a distance is kept" '"within_bounds": true'
expect 2 "a file as folder" $urdf -o budgets.yaml
expect 2 "a name of a package" $urdf -o none --package "My Robot"
expect 2 "a package without a name" $urdf -o none --package ''
expect 3 "no robot" $prohull urdf nowhere.urdf -o none
rm before/meshes/knot.ply
expect 3 "a missing mesh" $prohull urdf before/robot.urdf -o none
says err "a missing mesh" "--skip-missing"
says err "a missing mesh" "knot.ply"
expect 3 "a dry run with a missing mesh" $prohull urdf before/robot.urdf --dry-run
says out "a dry run with a missing mesh" "an error, as its mesh is missing"
printf '<robot name="r"><link name="a"><visual><geometry><mesh filename="a.msh"/></geometry></visual></link></robot>' >msh.urdf
printf 'no mesh' >a.msh
expect 3 "a dry run with a mesh that is not read" $prohull urdf msh.urdf --dry-run
says out "a dry run with a mesh that is not read" "a.msh: an error: "
rm msh.urdf a.msh
expect 0 "a dry run that skips a missing mesh" $prohull urdf before/robot.urdf --dry-run --skip-missing
absent none "what is refused leaves nothing"
expect 0 "a missing mesh is skipped" $prohull urdf before/robot.urdf -o skipped --skip-missing $small
says out "a missing mesh is skipped" "left as it is, with nothing proven"
printf '<!DOCTYPE r [<!ENTITY a "aaaa">]><robot name="&a;"/>' >bomb.urdf
expect 3 "entities" $prohull urdf bomb.urdf --check
says err "entities" "bomb.urdf: line 1: "
mkdir closed && chmod 555 closed
if [ ! -w closed ]; then
  expect 3 "a folder that takes no files" $urdf -o closed/out $small
fi

# --- links with collision geometry only ---
{
  echo '<robot name="two"><link name="base"><visual><geometry><box size="0.2 0.2 0.1"/></geometry></visual></link>'
  for i in 1 2 3 4 5 6; do
    echo "<link name='wall$i'><collision><geometry><box size='0.02 0.4 0.6'/></geometry></collision></link>"
    echo "<joint name='fix$i' type='fixed'><parent link='base'/><child link='wall$i'/></joint>"
  done
  echo '</robot>'
} >walls.urdf
expect 0 "collision geometry only" $prohull urdf walls.urdf -o walls $small
says out "collision geometry only" "6 links have collision geometry only, which they keep, and nothing about them was looked at: wall1, wall2, wall3, wall4, wall5, and 1 more"
says out "no hull has a reason" "no hull was made: 1 link has primitives only, which are kept; 6 links have collision geometry only, which --from collision takes"
says walls/report.json "collision geometry only: JSON" "It has collision geometry only, which it keeps; nothing about it was looked at."
says walls/walls.srdf "the SRDF tells which links it is about" "Of links whose collision geometry is proven to cover them"
expect 0 "what the reason says" $prohull urdf walls.urdf -o walls_from $small --from collision
says_not out "what the reason says" "collision geometry only"
says walls_from/walls.srdf "what the reason says" 'link2="wall6"'

# --- a model of Gazebo ---
mkdir -p models/ball/meshes
$prohull sample sphere --faces 200 -o models/ball/meshes/ball.stl >/dev/null
cat >models/ball/model.sdf <<END
<sdf version="1.9"><model name="ball"><link name="base"><visual name="v"><geometry><mesh>
<uri>model://ball/meshes/ball.stl</uri></mesh></geometry></visual></link></model></sdf>
END
expect 0 "a model" $prohull urdf models/ball/model.sdf -o model_out $small
says model_out/model.sdf "a model opens where it was written" "<uri>../models/ball/meshes/ball.stl</uri>"
expect 0 "a model opens where it was written" $prohull urdf model_out/model.sdf --check
expect 0 "a model beside it" $prohull urdf models/ball/model.sdf -o models/ball_safe $small
says models/ball_safe/model.sdf "a model that is found keeps its URI" "<uri>model://ball/meshes/ball.stl</uri>"
expect 0 "a model beside it opens" $prohull urdf models/ball_safe/model.sdf --check

# --- Ctrl-C ---
$prohull sample knot --faces 300000 -o robot/meshes/knot.ply >/dev/null
$urdf -o interrupted --faces 500 --no-cache >out 2>err &
sleep 1
kill -INT $!
wait $!
code=$?
is "Ctrl-C: exit code $code" test $code -eq 130
says err "Ctrl-C" "interrupted"
absent "interrupted .interrupted*" "Ctrl-C"
