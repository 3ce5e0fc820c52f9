# Drives `prohull motion` as a user would
# --- a base and a cart, cubes of side 1 m; the joint `slide` says how far they are apart ---
cat >slide.urdf <<'URDF'
<robot name="slide">
  <link name="base"><collision><geometry><box size="1 1 1"/></geometry></collision></link>
  <link name="rail"><collision><geometry><box size="0.1 0.1 0.1"/></geometry></collision></link>
  <link name="cart"><collision><geometry><box size="1 1 1"/></geometry></collision></link>
  <link name="flag"><visual><geometry><box size="0.1 0.1 0.1"/></geometry></visual></link>
  <joint name="up" type="prismatic">
    <parent link="base"/><child link="rail"/><origin xyz="0 0 3"/><axis xyz="0 0 1"/>
    <limit lower="0" upper="5" effort="1" velocity="1"/>
  </joint>
  <joint name="slide" type="prismatic">
    <parent link="rail"/><child link="cart"/><origin xyz="1 0 -3"/><axis xyz="1 0 0"/>
    <limit lower="-2" upper="5" effort="1" velocity="1"/>
  </joint>
  <joint name="turn" type="continuous"><parent link="cart"/><child link="flag"/><origin xyz="0 0 -3"/></joint>
</robot>
URDF
motion="$prohull motion slide.urdf"
printf 'time,slide\n0,1\n2,0.5\n' >free.csv
printf 'time,slide\n0,1\n2,-1\n' >meets.csv
printf '{"joint_names": ["slide"], "points": [{"positions": [1], "velocities": [-3], "time_from_start": 0},
  {"positions": [1], "velocities": [3], "time_from_start": {"sec": 2, "nanosec": 0}}]}' >cubic.json

expect 0 "free" $motion free.csv --report free.json
says out "free" "free.csv: free all along, proven for 2 rows, 2 s"
says out "joints at rest are named" "the path does not name these joints, which stay: up at 0, turn at 0"
says out "links without collision geometry are named" "their visual geometry counts: flag"
says free.json "report: free" '"verdict": "free"'
expect 1 "meets" $motion meets.csv --report meets.json
says out "meets" "meets.csv: MEETS at 1 s: base and cart; proven free before 0.999999 s"
says out "where it meets" "there: up 0, slide 0, turn 0"
says meets.json "report: meets" '"verdict": "meets"'
says meets.json "report: witness" '"witness": {'
expect 1 "a cubic meets where straight lines would not" $motion cubic.json
says out "a cubic" "cubic.json: MEETS at 0.4226497"
printf 'time,slide\n1700000000,1\n1700000002,-1\n' >epoch.csv
expect 1 "seconds since 1970" $motion epoch.csv
says out "seconds since 1970" "MEETS at 1700000001 s: base and cart; proven free before 1700000000.99999"
expect 1 "an earlier contact is undecided" $motion meets.csv --cells 3
says out "an earlier contact is undecided" "proven free before 0.5 s; undecided between: base and cart: the number of cells is used up, which --cells makes larger"
expect 1 "several paths" $motion free.csv meets.csv cubic.json --threads 1
says out "several paths" "free.csv: free all along"
says out "several paths" "cubic.json: MEETS"
expect 0 "a pair to ignore" $motion meets.csv --ignore cart,base --report ignored.json
says out "a pair that is left out is named" "free all along, but for 1 pair that may touch (base and cart), proven for"
says out "pairs that are left out are counted" "2 pairs of bodies, 1 left out; read"
is "report: what is left out" python3 -c "import json; assert json.load(open('ignored.json'))['left_out'] == [['base', 'cart']]"
expect 0 "neighbours are no exception" $motion free.csv --ignore base,rail
says out "neighbours are no exception" "free all along, proven"
expect 0 "a path from standard input" sh -c "$motion - <free.csv"
says out "a path from standard input" "standard input: free"
expect 1 "a gap" $motion free.csv --gap 60cm
says out "a gap" "base and cart; proven free before 1.59999 s"
printf 'slide\n-1\n' >through.csv
expect 1 "several pairs within a gap" $motion through.csv --gap 4m
says out "several pairs within a gap" "are closer and 0 are open"
expect 0 "a smaller gap" $motion free.csv --gap 499mm
expect 1 "visual geometry, of which the base has none" $motion meets.csv --geometry visual
says out "visual geometry" "so that their collision geometry counts: base, rail, cart"

# --- limits ---
printf 'slide,turn\n1,100\n5.5,0\n' >beyond.csv
expect 1 "beyond limits" $motion beyond.csv
says out "beyond limits is free" "beyond.csv: free all along"
says out "beyond limits" "BEYOND LIMITS: line 3: slide is at 5.5, and its limits are -2 and 5"

printf 'slide\n5.0000001\n' >hair.csv
expect 1 "a hair beyond limits" $motion hair.csv
says out "a hair beyond limits" "slide is at 5.0000001, and its limits are -2 and 5"
printf 'slide,slide.velocity\n4.5,4\n4.5,-4\n' >overshoot.csv
expect 1 "beyond limits between rows" $motion overshoot.csv --report overshoot.json
says out "beyond limits between rows" "BEYOND LIMITS: after line 2: slide is at 5.5, and its limits are -2 and 5"
says overshoot.json "report: beyond limits between rows" '"time": 0.5'
cat >gantry.urdf <<'URDF'
<robot name="gantry">
  <link name="frame"><collision><geometry><box size="2 2 0.1"/></geometry></collision></link>
  <link name="bridge"/>
  <link name="tool"><collision><geometry><box size="0.1 0.1 0.5"/></geometry></collision></link>
  <joint name="x" type="prismatic"><parent link="frame"/><child link="bridge"/><axis xyz="1 0 0"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
  <joint name="z" type="prismatic"><parent link="bridge"/><child link="tool"/><origin xyz="0 0 1"/><axis xyz="0 0 1"/>
    <limit lower="-2" upper="1" effort="1" velocity="1"/></joint>
</robot>
URDF
printf 'x,z\n0,0\n0,-1\n' >down.csv
expect 1 "links between which two joints move are compared" $prohull motion gantry.urdf down.csv
says out "links between which two joints move are compared" "MEETS at row 0.70000000000"

# --- the curve ---
expect 0 "curve" $motion free.csv --curve curve.csv
says out "curve" "; at least "
says curve.csv "curve" "begin,end,distance,a,b"
is "the curve is below the distance, and above 0.6 of it" awk -F, 'NR > 1 {
    if ($1 != end + 0) exit 1
    end = $2
    for (t = $1; t <= $2; t += ($2 - $1) / 4) if ($3 > 1 - t / 4 || $3 < 0.6 * (1 - t / 4)) exit 1 }
  END { exit end != 2 }' curve.csv
printf 'slide\n0.123456\n' >still.csv
expect 0 "a bound of a distance is rounded down" $motion still.csv --curve still_curve.csv
says out "a bound of a distance is rounded down" "; at least 123.4 mm apart"
expect 2 "a curve of two paths" $motion free.csv meets.csv --curve curve2.csv
absent curve2.csv "what is refused writes nothing"

# --- the page ---
expect 2 "a page is HTML" $motion free.csv --page page.stl
if "$prohull" view slide.urdf -o view.html >/dev/null 2>&1; then
  expect 0 "a page" $motion free.csv --page page.html
  says page.html "what is proven stands on the page" "free all along, proven for 2 rows, 2 s; at least"
  printf 'time,slide\n0,1\n2,6\n' >out.csv
  expect 1 "a page of a path that leaves the limits" $motion out.csv --page out.html
  says out.html "the limits stand on the page" "BEYOND LIMITS: line 3: slide is at 6"
fi

# --- open ---
printf 'slide,slide.velocity\n1.000001,-4\n1.000001,4\n' >close.csv
expect 4 "open" $motion close.csv --cells 10
says out "open" "OPEN from row "
says out "why it is open" "base and cart: the number of cells is used up"
expect 0 "with more cells it is free" $motion close.csv

# --- the world ---
cat >table.off <<'MESH'
OFF
8 6 0
-3000 -3000 -700
3000 -3000 -700
3000 3000 -700
-3000 3000 -700
-3000 -3000 -500
3000 -3000 -500
3000 3000 -500
-3000 3000 -500
4 3 2 1 0
4 4 5 6 7
4 0 1 5 4
4 1 2 6 5
4 2 3 7 6
4 3 0 4 7
MESH
world="--world table.off --unit mm"
expect 1 "the base stands on the table" $motion free.csv $world
says out "the base stands on the table" "MEETS at 0 s: base and table"
says out "what to do about it" "if they may touch, add --ignore base,table"
expect 1 "the cart touches it, too" $motion free.csv $world --ignore base,table
says out "the cart touches it, too" "MEETS at 0 s: cart and table"
expect 0 "lifted" sh -c "printf 'slide,up\n1,0.001\n0.5,0.001\n' | $motion - $world --ignore base,table"
expect 2 "a name that is not there" $motion free.csv $world --ignore base,desk
says err "a name that is not there" "is called 'desk'; there are base, rail, cart, flag, table"
expect 2 "one name" $motion free.csv --ignore base
cp table.off cart.off
expect 2 "a mesh with the name of a link" $motion free.csv --world cart.off
says err "a mesh with the name of a link" "two bodies are called 'cart'"
expect 3 "a world that is not there" $motion free.csv --world nowhere.stl

sed -n 's/^4 \(.*\) \(.*\) \(.*\) \(.*\)$/4 \4 \3 \2 \1/p; /^4 /!p' table.off >room.off
expect 1 "a mesh of the world that is inside out is turned" $motion free.csv --world room.off --unit mm
says out "what was turned is said" "room is inside out: it was turned, so that its inside counts as solid"
{
  printf 'OFF\n16 12 0\n'
  sed -n '3,10p' table.off
  sed -n '3,10p' table.off | awk '{ print $1 + 1e5, $2, $3 }'
  grep '^4 ' table.off
  grep '^4 ' room.off | awk '{ print 4, $2 + 8, $3 + 8, $4 + 8, $5 + 8 }'
} >half.off
expect 1 "a component of the world that is inside out" $motion free.csv --world half.off --unit mm
says out "which component was turned" "the component of face 12 of half is inside out: it was turned, so that its inside counts as solid"
expect 1 "a table whose faces look outwards" $motion free.csv $world
is "what was not turned is not said to be" sh -c '! grep -q "inside out" out'

# --- SRDF ---
echo '<robot name="slide"><disable_collisions link1="cart" link2="base" reason="User"/></robot>' >slide.srdf
expect 0 "disabled pairs" $motion meets.csv --srdf slide.srdf
says out "disabled pairs are named" "but for 1 pair that may touch (base and cart)"
sed 's/name="slide"/name="glide"/' slide.srdf >glide.srdf
expect 0 "an SRDF with another name" $motion meets.csv --srdf glide.srdf --report glide.json
for file in out glide.json; do
  says $file "an SRDF with another name" "glide.srdf: it is of the robot 'glide', not of 'slide'"
done
sed -i 's/"cart"/"wagon"/' glide.srdf
expect 3 "an SRDF of another robot" $motion meets.csv --srdf glide.srdf
says err "an SRDF of another robot" "no row of it names two links of this robot"
expect 3 "no SRDF" $motion meets.csv --srdf free.csv
cat >all.srdf <<'SRDF'
<robot name="slide">
  <disable_collisions link1="cart" link2="base"/><disable_collisions link1="base" link2="flag"/>
  <disable_collisions link1="rail" link2="flag"/>
</robot>
SRDF
expect 2 "nothing to check is no proof" $motion meets.csv --srdf all.srdf
says err "nothing to check is no proof" "there is no pair of bodies that could meet"

# --- what is refused ---
expect 2 "no path" $motion
expect 3 "a path that is not there" $motion nowhere.csv
printf 'slide\n1\nnan\n' >nan.csv
expect 3 "not a number" $motion free.csv nan.csv
says err "not a number" "nan.csv: line 3: 'nan' is no finite number"
printf 'slyde\n1\n' >unknown.csv
expect 3 "an unknown joint" $motion unknown.csv
says err "an unknown joint" "unknown.csv: the robot has no joint 'slyde'; it has up, slide, turn"
: >empty.csv
expect 3 "an empty path" $motion empty.csv
expect 3 "no robot" $prohull motion free.csv free.csv
sed 's|<box size="0.1 0.1 0.1"/>|<mesh filename="lost.stl"/>|' slide.urdf >lost.urdf
expect 3 "a lost mesh" $prohull motion lost.urdf free.csv
says err "a lost mesh" "lost.stl"
sed 's|<link name="rail">.*|<link name="rail"><collision><geometry><ellipsoid size="1 1 1"/></geometry></collision></link>|' \
  slide.urdf >unread.urdf
expect 4 "geometry that is not read is not free" $prohull motion unread.urdf free.csv
says out "geometry that is not read is not free" "OPEN from 0 s to 2 s: rail and flag: its geometry of type ellipsoid is not read"

# --- the arm, and Ctrl-C ---
$prohull sample arm -o arm >/dev/null
expect 0 "the arm in coarse hulls" \
  $prohull urdf arm/arm.urdf -o coarse --faces 60 --configurations 0 --no-pictures --threads 1
echo '<robot name="a"><disable_collisions link1="link2" link2="link5" reason="sampled"/></robot>' >sampled.srdf
expect 1 "a row that random configurations suggest" $prohull urdf coarse/arm.urdf --check --srdf sampled.srdf
says out "a row that random configurations suggest" "yes: the collision geometry covers"
says out "a row that random configurations suggest" 'link2 and link5, "sampled": REFUTED: the collision geometry meets at'
says out "a row that random configurations suggest" "the visual geometry never meets, proven"
printf 'joint3,joint4,joint5\n0,0,0\n0.226562,-4.48926,-1.40469\n' >fold.csv
expect 1 "a path to that position" $prohull motion coarse/arm.urdf fold.csv --report fold.json
says fold.json "a path to that position" '"link5"'
awk 'BEGIN { srand(1); print "joint1,joint2,joint3,joint4,joint5,joint6,joint7"
  for (i = 0; i < 20000; ++i) { for (j = 0; j < 7; ++j) printf "%s%f", j ? "," : "", 2 * rand() - 1; print "" } }' >long.csv
$prohull motion arm/arm.urdf long.csv >out 2>err &
sleep 1
kill -INT $!
wait $!
code=$?
is "Ctrl-C: exit code $code" test $code -eq 130

# --- certificates: a name with a new line in it writes no line of its own ---
$prohull sample box --faces 100 -o box.stl -q
cp box.stl "$(printf 'part\nframe.stl')"
geometry() { echo "<collision>${2:-}<geometry><mesh filename=\"$1\"/></geometry></collision>"; }
hinge() {
  echo "<joint name=\"$1\" type=\"revolute\"><parent link=\"$2\"/><child link=\"$3\"/><axis xyz=\"0 0 1\"/>" \
    "<limit lower=\"-1\" upper=\"1\" effort=\"1\" velocity=\"1\"/></joint>"
}
echo "<robot name=\"r\"><link name=\"a\">$(geometry 'part&#10;frame.stl')</link><link name=\"b\"/><link name=\"c\">" \
  "$(geometry box.stl '<origin xyz="99 0 0"/>')</link>$(hinge j1 a b)$(hinge j2 b c)</robot>" >line.urdf
printf 'j1,j2\n0,0\n0.1,0.1\n' >line.csv
expect 0 "a new line in a name" $prohull motion line.urdf line.csv --certificate line.phmotion
says line.phmotion "a new line in a name: triangles" "triangles "
is "a new line in a name: no line of its own" test "$(grep -c '^frame.stl' line.phmotion)" = 0
