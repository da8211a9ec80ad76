#!/usr/bin/env bash
# Installs the packages of a folder on a minimal Debian of its own, and uses them there: a model from
# the command line, then the examples and the project of test/consumer built with CMake, and an
# example with pkg-config. Needs root and network.
# cmake/check_packages.sh FOLDER
set -euo pipefail
packages=$(realpath "$1")
source=$(realpath "$(dirname "${BASH_SOURCE[0]}")/..")
root=$(mktemp -d)
chmod 755 "$root"
trap 'umount "$root/proc" 2>/dev/null || true; rm -rf "$root" "$root.log"' EXIT

# The same release and mirror as this system.
. /etc/os-release
mirror=$(apt-get indextargets --format '$(REPO_URI)' "Codename: $VERSION_CODENAME" | head -n 1)
debootstrap --variant=minbase "$VERSION_CODENAME" "$root" "$mirror" >"$root.log" || { tail "$root.log"; exit 1; }
rm "$root/etc/apt/sources.list"
cp -r /etc/apt/. "$root/etc/apt/"
mount -t proc proc "$root/proc"  # the installation of Java, which VTK's development files need, reads it
cp /etc/resolv.conf "$root/etc/"
mkdir "$root/packages"
cp "$packages"/*.deb "$root/packages/"
cp -r "$source/apps/examples" "$root/examples"
mkdir "$root/test"
cp -r "$source/test/consumer" "$source/test/foreign_point.h" "$root/test/"

chroot "$root" /bin/bash -euc '
  export DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8
  apt-get update -qq
  install() { apt-get install -y -qq --no-install-recommends "$@" >/dev/null; }
  echo "== the tools alone"
  install /packages/storey-tools_*.deb /packages/libstorey[0-9]*.deb
  storey_synth two_towers -o /tmp/cloud.ply --truth /tmp/truth.ply
  storey_reconstruct /tmp/cloud.ply -o /tmp/model
  storey_evaluate /tmp/model/model.ply /tmp/truth.ply
  echo "== the development files"
  install /packages/libstorey-dev_*.deb g++ cmake make pkg-config
  cmake -S /examples -B /tmp/build >/dev/null
  cmake --build /tmp/build >/dev/null
  /tmp/build/five_classes /tmp/cloud.ply /tmp/model.vtk
  cmake -S /test/consumer -B /tmp/consumer >/dev/null
  cmake --build /tmp/consumer >/dev/null
  /tmp/consumer/readme_example
  /tmp/consumer/foreign_point
  g++ /examples/floorplans.cpp -o /tmp/floorplans \
    $(pkg-config --cflags --libs storey_surface pcl_io) -lboost_filesystem  # which pcl_io.pc forgets
  /tmp/floorplans /tmp/cloud.ply
  echo "== removed without a trace"
  apt-get purge -y -qq storey-tools libstorey-dev "libstorey[0-9].*" >/dev/null
  ! find / -xdev -name "*storey*" -not -path "/packages/*" -not -path "/tmp/*" -not -path "/proc/*" \
    -not -path "/var/lib/apt/*" | grep .
'
