# Drives `prohull contains` and `prohull distance`
make_rock
make_unit
make_broken

# --- points ---
printf '0,0,0,1,1,1\n0,nan,0,1,1,1\n' >nan.csv
printf 'x,y,z\n0.25,0.25,0.25\n0.25,0.25,-2\n3,0,0\n' >points.csv
printf 'point,inside\n0,1\n1,0\n2,0\n' >expected.csv
expect 0 "contains" $prohull contains unit.off --points points.csv -o inside.csv --report inside.json
same "contains" inside.csv expected.csv
says out "contains" "inside.csv: 1 of 3 points inside (33.33 %)"
says inside.json "report of contains" '"inside": 1'
gzip -kf points.csv
expect 0 "contains, piped" sh -c "$prohull contains unit.off --points - -o - --out-format csv <points.csv.gz >again.csv"
same "contains, piped" again.csv expected.csv
expect 0 "distance" $prohull distance unit.off --points points.csv -o distances.csv --report distances.json
says distances.csv "distance" "point,distance,lower,upper,face,x,y,z"
says distances.csv "distance" "1,2,1.9999"
says distances.csv "distance" ",0,0.25,0.25,0"
says distances.csv "distance" ",0,1,0,0"
says out "distance" "3 points at distances from 0.144338 to 2"
says distances.json "report of distance" '"greatest_distance": 2.0'
expect 0 "signed distance" $prohull distance unit.off --points points.csv -o distances.csv --signed
says distances.csv "signed distance" "0,-0.1443"
for command in contains distance; do
  expect 0 "$command of random points" $prohull $command rock.ply --random 3000 --write-points random.npy -o random.npz
  says out "$command of random points" "3,000 random points, seed 1"
  expect 0 "$command, one thread" $prohull $command rock.ply --points random.npy -o again.npz --threads 1
  same "$command, one thread" random.npz again.npz
  expect 0 "$command of a .phull" $prohull $command rock.phull --random 3000 -o again.npz
  same "$command of a .phull is that of its original" random.npz again.npz
  expect 2 "$command without points" $prohull $command unit.off -o bad_points.csv
  says err "$command without points" "--points"
  expect 3 "$command of no point" $prohull $command unit.off --points nan.csv -o bad_points.csv
  says err "$command of no point" "nan.csv: line 1: "
  expect 3 "$command of an empty file" $prohull $command unit.off --points /dev/null -o bad_points.csv
  says err "$command of an empty file" "/dev/null: there are no points"
  expect 2 "$command by a filter" $prohull $command rock.phull --random 10 --engine filter -o bad_points.csv
  says err "$command by a filter" "--engine must be auto, bvh, brute, refinement, paper-refinement or walk, not 'filter'"
  expect 3 "$command of no faces" $prohull $command empty.off --points points.csv -o bad_points.csv
  says err "$command of no faces" "empty.off: it has no faces"
done
sed '2s/4 4 0/4 3 0/; $d' unit.off >open.off
$prohull contains unit.off --points points.csv -o closed_points.csv >/dev/null
expect 0 "contains of an open mesh" $prohull contains open.off --points points.csv -o open_points.csv
says out "contains of an open mesh" "it is not closed, and the solid is asked that \`prohull repair\` makes of it: closed 1 opening"
is "contains of an open mesh" cmp closed_points.csv open_points.csv
printf 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n' >leaf.off
expect 3 "contains of a leaf" $prohull contains leaf.off --points points.csv -o bad_points.csv
says err "contains of a leaf" "leaf.off: the mesh is not closed"
expect 3 "signed distance of an open mesh" $prohull distance open.off --points points.csv -o bad_points.csv --signed
expect 0 "distance of an open mesh" $prohull distance open.off --points points.csv
absent "bad_points.csv" "commands that ask points"
