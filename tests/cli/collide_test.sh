# Drives `prohull collide`
make_rock
make_inner

# --- meshes against meshes ---
printf 'OFF\n6 8 0\n1 0 0\n-1 0 0\n0 1 0\n0 -1 0\n0 0 1\n0 0 -1\n3 0 2 4\n3 2 1 4\n3 1 3 4\n3 3 0 4\n3 2 0 5\n3 1 2 5\n3 3 1 5\n3 0 3 5\n' >octahedron.off
expect 0 "collide: free" $prohull collide octahedron.off octahedron.off --pose 5,0,0,1,0,0,0 --distance --report collide.json
says out "it says so" "free: octahedron.off and octahedron.off, exactly"
says out "the distance" "3 apart, proven between"
says collide.json "report: collide" '"colliding": 0'
expect 1 "collide: touching" $prohull collide octahedron.off octahedron.off --pose '2 0 0 1 0 0 0' -o pairs.csv
says out "the pairs" "meet in 16 pairs of faces"
says pairs.csv "rows of pairs" "pose,face_a,face_b"
printf 'x,y,z,qw,qx,qy,qz\n5,0,0,1,0,0,0\n0,0,1,0,0,0,1\n' >poses.csv
expect 1 "collide: many poses" $prohull collide octahedron.off octahedron.off --poses poses.csv --distance
says out "how many" "1 of 2 poses collide"
says out "the nearest" "nearest of those that are free, pose 0: 3 apart"
expect 0 "collide: conservative" $prohull collide rock.phull rock.phull --pose 1,0,0,100,0,1,0,0,0,0,1,0 --conservative
says out "certain" "free: rock.phull and rock.phull, for certain"
expect 1 "collide: may" $prohull collide rock.phull rock.phull --conservative
says out "not certain" "MAY COLLIDE"
expect 2 "collide: no pose" $prohull collide octahedron.off octahedron.off --pose 1,2,3
says err "what a pose is" "x,y,z,qw,qx,qy,qz"
expect 2 "collide: a mirror" $prohull collide octahedron.off octahedron.off --pose 1,0,0,0,0,1,0,0,0,0,-1,0
says err "rigid" "not rigid"
printf '1,0,0,1,0,0,0\n1,0,0,0,0,0,0\n' >bad.csv
echo x,y,z,qw,qx,qy,qz >names.csv
for file in /dev/null names.csv; do
  expect 3 "collide: no poses in $file" $prohull collide octahedron.off octahedron.off --poses $file
  says err "collide: no poses in $file" "$file: there are no poses"
done
printf 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n' >leaf.off
expect 0 "collide: a sheet with itself" $prohull collide leaf.off leaf.off --pose 5,0,0,1,0,0,0
is "collide: a sheet with itself, one note" test "$(grep -c 'is not closed' out)" -eq 1
expect 2 "collide: inner hulls, conservatively" $prohull collide inner.phull rock.ply --conservative
says err "collide: inner hulls, conservatively" "inner.phull: it holds inner hulls"
expect 3 "collide: bad poses" $prohull collide octahedron.off octahedron.off --poses bad.csv
says err "the line" "bad.csv: line 2"
