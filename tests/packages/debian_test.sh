#!/bin/sh
# Makes the Debian packages, unpacks them and uses what is in them: debian_test.sh BUILD CMAKE CPACK HAS_IMPORTER
set -eu
build=$1 cmake=$2 cpack=$3 has_importer=$4
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

fail() {
  echo "FAILED: $1" >&2
  exit 1
}

"$cpack" --config "$build/CPackConfig.cmake" -G DEB -B "$work" -D CPACK_DEBIAN_COMPRESSION_TYPE=gzip >cpack.log 2>&1 ||
  { cat cpack.log; fail cpack; }
for package in prohull libprohull-dev; do
  ls "${package}"_*.deb >/dev/null || fail "no package $package"
done
for deb in *.deb; do
  dpkg-deb -x "$deb" root
  package=$(dpkg-deb -f "$deb" Package)
  documents=root/usr/share/doc/$package
  gzip -t "$documents/changelog.gz" "$documents/changelog.Debian.gz"
  grep -q "Permission is hereby granted" "$documents/copyright" || fail "$package: copyright"
  dpkg-deb -f "$deb" Depends | grep -q libtbb || fail "$package: libraries are missing in Depends"
  dpkg-deb -f "$deb" Maintainer | grep -q '^[A-Z].* <.*@.*>$' || fail "$package: Maintainer"
done

# Whatever `cmake --install` installs is in one of the packages; the completion of zsh in another folder there.
"$cmake" --install "$build" --prefix "$work/installed" >/dev/null
(cd installed && find . ! -type d ! -path './share/zsh/*') >installed.txt
[ "$(wc -l <installed.txt)" -gt 20 ] || fail "too little was installed"
while read -r file; do
  [ -e "root/usr/$file" ] || fail "in no package: $file"
done <installed.txt
[ -s root/usr/share/zsh/vendor-completions/_prohull ] || fail "completion of zsh"
gzip -dc root/usr/share/man/man1/prohull.1.gz | grep -q '^\.TH PROHULL 1' || fail "manual page"

# unbuilt COMMAND...: as it would run where prohull was never built
unbuilt() {
  env -u PROHULL_IMPORTER "$@"
}
root/usr/bin/prohull sample box -o box.stl --faces 200
unbuilt root/usr/bin/prohull build box.stl --faces 50 -o hull.stl | grep -q "certified: yes" || fail "prohull build"
if [ "$has_importer" = 1 ]; then
  printf 'AC3Db\nMATERIAL "m" rgb 1 1 1 amb 0 0 0 emis 0 0 0 spec 0 0 0 shi 0 trans 0\nOBJECT poly\nnumvert 3\n0 0 0\n1 0 0\n0 1 0\nnumsurf 1\nSURF 0x00\nmat 0\nrefs 3\n0 0 0\n1 0 0\n2 0 0\nkids 0\n' >part.ac
  unbuilt root/usr/bin/prohull info part.ac | grep -q "faces  *1$" || fail "prohull-import of the package is not found"
fi
if [ -d root/usr/lib/python3 ]; then
  PYTHONPATH=root/usr/lib/python3/dist-packages /usr/bin/python3 -B -c '
import prohull
assert "dist-packages" in prohull.__file__, prohull.__file__
assert prohull.build("box.stl", target_faces=50).certified' || fail "import prohull"
fi
echo "packages: $(ls *.deb | tr '\n' ' ')"
