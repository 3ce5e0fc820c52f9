# Meshes that several tests ask about; each function makes files in the current folder.

# An asteroid rock.ply, its hull hull.stl, and all levels between them, rock.phull.
make_rock() {
  $prohull sample asteroid -o rock.ply --faces $((20000 / divisor)) >/dev/null
  $prohull build rock.ply --faces 500 -o hull.stl --hierarchy rock.phull --report hull.json >/dev/null
}

# Its inner hull, inner.obj, and the levels, inner.phull.
make_inner() {
  $prohull build rock.ply --side inner --faces 500 -o inner.obj --hierarchy inner.phull >/dev/null
}

make_knot() {
  $prohull sample knot -o knot.ply --faces 3000 >/dev/null
}

# The unit tetrahedron; its faces are 0: z = 0, 1: y = 0, 2: oblique, 3: x = 0.
make_unit() {
  printf 'OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n' >unit.off
}

# A ray that enters it and one that misses it.
make_rays() {
  printf '0.25,0.25,-0.5,0,0,2\n0.25,0.25,-0.5,0,0,-1\n' >rays.csv
}

# Meshes that are no solid: each lacks what its name says, or has too much of it.
make_broken() {
  printf 'OFF\n4 4 0\n0 0 0\n1 0 0\n0 nan 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n' >nan.off
  printf 'OFF\n4 3 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n' >open.off
  printf 'OFF\n0 0 0\n' >empty.off
  printf 'OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 2 1\n' >flat.off
  printf 'OFF\n4 4 0\n0 0 0\n1e200 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n' >huge.off
  printf 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n' >sheet.off
  printf 'OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n3 0 3 1\n3 1 3 2\n3 2 3 0\n' >inside_out.off
}
