#!/bin/sh
# Makes the wheel that brings its libraries, installs it in a new virtual environment, which has numpy from the system, and
# uses it there: wheel_test.sh ROOT BUILD PYTHON HAS_IMPORTER
set -eu
root=$1 build=$2 python=$3 has_importer=$4
for tool in patchelf dpkg-query; do
  command -v $tool >/dev/null || { echo "skipped: $tool is missing"; exit 77; }
done
"$python" -c 'import numpy, pip, venv, wheel' || { echo "skipped: python3-numpy, -pip, -venv or -wheel is missing"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

fail() {
  echo "FAILED: $1" >&2
  exit 1
}

PROHULL_BUILD_DIR=$build PROHULL_SELF_CONTAINED=1 \
  "$python" -m pip wheel --quiet --no-build-isolation --no-deps --no-index --wheel-dir . "$root" >pip.log 2>&1 ||
  { cat pip.log; fail "pip wheel"; }
"$python" -m venv --without-pip --system-site-packages venv
"$python" -m pip --python venv/bin/python install --quiet --no-index prohull-*.whl

# bare COMMAND...: as it would run where prohull was never built
bare() {
  env -i PATH="$work/venv/bin:/usr/bin:/bin" HOME="$work" "$@"
}
package=$(bare python -c 'import prohull; print(prohull.__path__[0])')
case $package in
  "$work"/venv/*) ;;
  *) fail "the package is that in $package" ;;
esac

# Nothing but glibc and libstdc++, which all Debian systems have, comes from outside of the package.
for file in "$package"/prohull* "$package"/*.so "$package"/lib/*.so*; do
  bare ldd "$file" >needed.txt
  ! grep -v "=> $package/lib/" needed.txt | grep -Ev '^\s*(statically linked|linux-vdso|/lib64/ld-linux|lib(c|m|dl|rt|pthread|stdc\+\+|gcc_s)\.so)' ||
    fail "$file takes libraries from the system"
done
ls "$package"/lib/*.copyright >/dev/null || fail "the licences of the libraries are missing"

bare prohull sample knot -o knot.stl --faces 2000 >/dev/null
bare python -m prohull build knot.stl --faces 200 -o hull.stl | grep -q "certified: yes" || fail "python -m prohull build"
bare prohull verify hull.stl knot.stl >/dev/null || fail "prohull verify"
bare python -c '
import prohull
assert prohull.verify("hull.stl", "knot.stl")
assert prohull.build("knot.stl", 200).certified
' || fail "import prohull"
if bare prohull view hull.stl -o page.html 2>/dev/null; then
  bare python -c 'import prohull; prohull.view("hull.stl", original="knot.stl", path="view.html")' || fail "prohull.view"
fi
if [ "$has_importer" = 1 ]; then
  printf 'AC3Db\nMATERIAL "m" rgb 1 1 1 amb 0 0 0 emis 0 0 0 spec 0 0 0 shi 0 trans 0\nOBJECT poly\nnumvert 3\n0 0 0\n1 0 0\n0 1 0\nnumsurf 1\nSURF 0x00\nmat 0\nrefs 3\n0 0 0\n1 0 0\n2 0 0\nkids 0\n' >part.ac
  bare prohull info part.ac | grep -q "faces  *1$" || fail "prohull-import of the wheel is not found"
fi
echo "$(ls prohull-*.whl): $(($(wc -c <"$(ls prohull-*.whl)") / 1000000)) MB"
