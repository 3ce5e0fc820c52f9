# Drives `prohull sweep` as a user would
cat >bar.off <<'MESH'
OFF
8 6 0
0 -0.1 0
1 -0.1 0
1 0.1 0
0 0.1 0
0 -0.1 0.2
1 -0.1 0.2
1 0.1 0.2
0 0.1 0.2
4 3 2 1 0
4 4 5 6 7
4 0 1 5 4
4 1 2 6 5
4 2 3 7 6
4 3 0 4 7
MESH
sweep="$prohull sweep bar.off"

# --- a mesh that turns ---
expect 0 "a quarter turn" $sweep --angle 90 -o quarter.stl --report quarter.json
says out "a quarter turn" "certified: yes, the union of the pieces as written encloses the mesh, at every moment"
says quarter.json "the report" '"certified": true'
says quarter.json "the report" '"encloses_solid": true'
says quarter.json "the report: what was read" '"diagonal": '
says quarter.json "the report: how it moved" '"angle_degrees": 90.0'
expect 0 "it covers the beginning" $prohull verify quarter.stl bar.off
printf 'OFF\n8 6 0\n0.1 0 0\n0.1 1 0\n-0.1 1 0\n-0.1 0 0\n0.1 0 0.2\n0.1 1 0.2\n-0.1 1 0.2\n-0.1 0 0.2\n' >end.off
sed -n 11,16p bar.off >>end.off
expect 0 "it covers the end" $prohull verify quarter.stl end.off
expect 0 "the axis as a vector, through a point" \
  $sweep --axis 0,0,2 --through 0,0,7 --angle 90 -o vector.obj --threads 1
says vector.obj "an object for each piece" "o piece_01"
printf 'OFF\n8 6 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n' >cube.off
sed -n '11,16p' bar.off >>cube.off
expect 0 "many slices" $prohull sweep cube.off --angle 90 --max-distance 0.1% --pieces 1 -o many.obj --report many.json
says out "the volume of many slices is 1 + pi / 2" "volume about 2.57,"
says many.json "the volume of many slices" '"volume_error": '
expect 0 "more slices" $sweep --angle 90 --max-distance 0.2% -o fine.ply
expect 0 "one mesh" $sweep --angle 90 --faces 100 -o hull.stl
says out "one mesh" "hull of 100 faces"
says out "one mesh" "certified: yes, the hull as written encloses the mesh"
expect 0 "one mesh covers the end" $prohull verify hull.stl end.off
expect 0 "standard output" $sweep --angle 90 -o - --out-format stl
is "standard output gets the same" cmp out quarter.stl

# --- other motions ---
expect 0 "a straight move" $sweep --move 0,0,1 -o move.stl
says out "a straight move" "1 convex piece, volume about 0.24,"
expect 0 "a screw" $sweep --angle 720 --move 0,0,1 -o screw.stl
printf 'x,y,z,qw,qx,qy,qz\n0,0,0,1,0,0,0\n0,0,0,1,0,0,1\n' >poses.csv
expect 0 "poses" $sweep --poses poses.csv -o poses.stl
says_not out "poses that are rotations" "rotation"
expect 0 "poses cover the end" $prohull verify poses.stl end.off
printf '1.0000004,0,0,0,0,1.0000004,0,0,0,0,1.0000004,0\n1.0000004,0,0,1,0,1.0000004,0,0,0,0,1.0000004,0\n' >nearly.csv
expect 0 "poses that are nearly rotations" $sweep --poses nearly.csv -o poses.stl --report nearly.json
says out "poses that are nearly rotations" "2 matrices of the poses are no rotations, but nearly"
says nearly.json "poses that are nearly rotations" "differ from theirs by up to 4.1e-07"
printf 'bar.off 1\n' >bad.csv
expect 3 "no poses" $sweep --poses bad.csv -o no.stl
says err "no poses" "bad.csv: a pose has 7 numbers, x,y,z,qw,qx,qy,qz; or 12, the upper three rows of a matrix of 4 x 4; or all 16; this one has 2"
echo '# none' >bad.csv
expect 3 "an empty file of poses" $sweep --poses bad.csv -o no.stl
says err "an empty file of poses" "bad.csv: there are no poses"
printf '0,0,0,1,0,0,0\n\n0,0,0,0,0,0,0\n' >zero.csv
expect 3 "a quaternion of nothing" $sweep --poses zero.csv -o no.stl
says err "a quaternion of nothing" "zero.csv: line 3: a quaternion of a pose must be finite, and not 0"

# --- what is refused ---
expect 2 "no motion" $sweep -o no.stl
says err "no motion" "how does it move?"
expect 2 "no turn" $sweep --angle 0 -o no.stl
says err "no turn" "with --angle 0 it does not move"
expect 2 "no shift" $sweep --move 0,0,0 -o no.stl
says err "no shift" "with --move 0,0,0 it does not move"
expect 2 "an axis without length" $sweep --axis 0,0,0 --angle 5 -o no.stl
expect 2 "no number" $sweep --axis nan,0,0 --angle 5 -o no.stl
expect 2 "poses and an angle" $sweep --poses poses.csv --angle 5 -o no.stl
expect 2 "too many slices" $sweep --angle 90 --max-distance 1e-9 -o no.stl
says err "too many slices" "more than 50000 convex pieces"
expect 2 "a path of a mesh" $sweep poses.csv -o no.stl
expect 3 "no mesh" $prohull sweep nowhere.stl --angle 5 -o no.stl
absent no.stl "what is refused writes nothing"

# --- a robot ---
cat >arm.urdf <<'URDF'
<robot name="arm">
  <link name="base"><collision><geometry><box size="0.1 0.1 0.1"/></geometry></collision></link>
  <link name="bar"><collision><origin xyz="0.5 0 0.1"/><geometry><box size="1 0.2 0.2"/></geometry></collision></link>
  <joint name="turn" type="revolute"><parent link="base"/><child link="bar"/><axis xyz="0 0 1"/>
    <limit lower="-3" upper="3" effort="1" velocity="1"/></joint>
</robot>
URDF
printf 'turn\n0\n1.5707963267948966\n' >turn.csv
expect 0 "a robot" $prohull sweep arm.urdf turn.csv -o arm.stl --report arm.json
says arm.json "a robot: its name" '"robot": "arm"'
says arm.json "a robot: the path of its joints" '"joint_path": "turn.csv"'
says out "a robot" "certified: yes, the union of the pieces as written encloses the links"
says arm.json "each link" '"link": "bar"'
says_not arm.json "no volume of the pieces of a robot" '"volume'
expect 0 "a robot at the beginning" $prohull verify arm.stl bar.off
expect 0 "one link" $prohull sweep arm.urdf turn.csv --links bar --faces 200 -o bar.glb
sed 's|<link name="base">.*|<link name="base"/>|' arm.urdf >bare.urdf
expect 0 "a workspace" $prohull sweep arm.urdf --workspace -o workspace.stl
says out "a workspace" "encloses the links, wherever the joints are within their limits"
says out "whose the pieces are" "base, bar in the frame of base: "
expect 0 "a root without a shape" $prohull sweep bare.urdf --workspace -o bare.stl --report bare.json
says out "a root without a shape" "  bar in the frame of base: "
says bare.json "a root without a shape" '"frame": "base"'
says bare.json "a root without a shape" '"link": null'
expect 0 "a robot in its workspace" $prohull verify workspace.stl bar.off
expect 2 "a workspace and a path" $prohull sweep arm.urdf turn.csv --workspace -o no.stl
expect 2 "the workspace of a mesh" $prohull sweep bar.off --angle 5 --workspace -o no.stl
sed 's/1.5707963267948966/99/' turn.csv >far.csv
expect 0 "a path beyond limits" $prohull sweep arm.urdf far.csv -o far.stl --report far.json
says out "a path beyond limits" "BEYOND LIMITS: "
says far.json "a path beyond limits, in JSON" '"joint": "turn",'
says far.json "a path beyond limits, in JSON" '"position": 99.0,'
says arm.json "a path within limits" '"beyond_limits": null'
expect 2 "no such link" $prohull sweep arm.urdf turn.csv --links elbow -o no.stl
says err "no such link" "the robot has no link 'elbow'"
expect 2 "a link without a shape" $prohull sweep bare.urdf turn.csv --links base,bar -o no.stl
says err "a link without a shape" "--links: 'base' has no shape"
expect 2 "a robot without a path" $prohull sweep arm.urdf -o no.stl
expect 2 "a robot that turns" $prohull sweep arm.urdf turn.csv --angle 5 -o no.stl
expect 2 "a robot in millimetres" $prohull sweep arm.urdf turn.csv --unit mm -o no.stl
says err "a robot in millimetres" "a robot is in metres: leave --unit and --scale out"

printf '%s\n' OFF '8 10 0' '0 0 0' '1 0 0' '1 1 0' '0 1 0' '0 0 1' '1 0 1' '1 1 1' '0 1 1' '3 0 2 1' '3 0 3 2' '3 0 1 5' \
  '3 0 5 4' '3 1 2 6' '3 1 6 5' '3 2 3 7' '3 2 7 6' '3 3 0 4' '3 3 4 7' >bucket.off
expect 0 "an open mesh" $prohull sweep bucket.off --angle 30 -o bucket.obj
says out "an open mesh" "and its inside with its openings closed by"
sed -n '3,10p' bucket.off | awk '{ print 3 * $1 - 1, 3 * $2 - 1, 3 * $3 - 1 }' >far_corners
{
  printf 'OFF\n16 24 0\n'
  sed -n '3,10p' bucket.off && cat far_corners
  sed -n '11,$p' bucket.off && printf '3 4 5 6\n3 4 6 7\n'
} | awk 'NF == 4 { print $1, $2, $4, $3; print $1, $2 + 8, $3 + 8, $4 + 8; next } 1' >hollow.off
expect 0 "a mesh with a cavity" $prohull sweep hollow.off --move 0.1,0,0 -o hollow.obj --report hollow.json
says out "a mesh with a cavity" "from what the mesh passes with cavities filled"
says hollow.json "a mesh with a cavity" '"fills_cavities": true'
expect 0 "pieces of a mesh with a cavity" $prohull convex hollow.off -o hollow.obj
says out "pieces of a mesh with a cavity" "of the diagonal) with cavities filled"

# --- a hull whose parts overlap ---
cat >crossed.urdf <<'URDF'
<robot name="crossed">
  <link name="base"><collision><origin rpy="0.3 0.2 0.1"/><geometry><box size="1 1 1"/></geometry></collision></link>
  <link name="slide"><collision><origin xyz="0 0.5 0" rpy="0 0.7 0"/><geometry><box size="1 1 1"/></geometry></collision></link>
  <joint name="move" type="prismatic"><parent link="base"/><child link="slide"/><axis xyz="1 0 0"/>
    <limit lower="0" upper="2" effort="1" velocity="1"/></joint>
</robot>
URDF
printf 'move\n0.5\n1.25\n' >crossed.csv
expect 0 "parts that overlap" $prohull sweep crossed.urdf crossed.csv --faces 40 -o crossed.ply --report crossed.json
expect 0 "parts that overlap, verified" $prohull verify crossed.ply crossed.ply
says_not out "parts that overlap" "intersects itself in 0 pairs"
says out "overlaps count once" "hull: volume 2.82815683"
says crossed.json "overlaps count once" '"volume": 2.82815683'
