# SPDX-License-Identifier: BSD-3-Clause
# From a bare Debian 12 to a finished build. Sourced by demo.sh and test.sh, which need the same.
#
# Every step looks first and works only if something is missing, so a second run touches neither
# the network nor a source file that did not change.

project_dir="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
build_dir="${HYBRIDTREE_BUILD_DIR:-$project_dir/build}"
pcl_dir="$build_dir/deps/pcl"
source "$project_dir/scripts/packages.sh"

say() { printf '\033[1m==> %s\033[0m\n' "$*"; }
fail() { printf 'error: %s\n' "$*" >&2; exit 1; }

# A language that every system has, whatever the caller's.
export LC_ALL=C.UTF-8

as_root()
{
  if [ "$(id -u)" -eq 0 ]; then
    env DEBIAN_FRONTEND=noninteractive "$@"
  elif command -v sudo >/dev/null; then
    sudo env DEBIAN_FRONTEND=noninteractive "$@"
  else
    fail "packages are missing and this is neither root nor a user with sudo; as root, run: $*"
  fi
}

is_installed()
{
  [ "$(dpkg-query -W -f '${db:Status-Status}' "$1" 2>/dev/null)" = installed ]
}

# Package lists are fetched at most once a run, and only if something has to be installed.
update_package_lists()
{
  [ -n "${lists_are_fresh:-}" ] && return
  say "fetching the package lists"
  as_root apt-get update -qq
  lists_are_fresh=1
}

install_packages()
{
  local missing=() package
  for package in "$@"; do
    is_installed "$package" || missing+=("$package")
  done
  [ ${#missing[@]} -eq 0 ] && return
  update_package_lists
  say "installing ${missing[*]}"
  as_root apt-get install -qq -y --no-install-recommends -o Dpkg::Use-Pty=0 \
    -o "Dpkg::Options::=--path-include=/usr/share/doc/libcgal-dev/*" "${missing[@]}" \
    >"$build_dir/apt.log" 2>&1 || { tail -n 20 "$build_dir/apt.log" >&2; fail "apt-get failed, see $build_dir/apt.log"; }
}

unpack_pcl()
{
  local stamp="$pcl_dir/.unpacked" packages="${pcl_packages[*]}"
  [ "$(cat "$stamp" 2>/dev/null)" = "$packages" ] && return
  update_package_lists
  say "unpacking PCL into $pcl_dir"
  rm -rf "$pcl_dir"
  mkdir -p "$pcl_dir/archives"
  # apt downloads as its own user, who may not be allowed into this folder: that is only a note.
  (cd "$pcl_dir/archives" && apt-get download -qq -o APT::Sandbox::User=root "${pcl_packages[@]}")
  local archive
  for archive in "$pcl_dir"/archives/*.deb; do
    dpkg -x "$archive" "$pcl_dir"
  done
  rm -r "$pcl_dir/archives"
  echo "$packages" >"$stamp"
}

# Options for cmake come as arguments and override the defaults.
configure_and_build()
{
  say "configuring"
  cmake -S "$project_dir" -B "$build_dir" -G Ninja -DCMAKE_BUILD_TYPE=Release \
    -DHYBRIDTREE_PCL_ROOT="$pcl_dir/usr" "$@" >"$build_dir/configure.log" 2>&1 \
    || { tail -n 40 "$build_dir/configure.log" >&2; fail "cmake failed, see $build_dir/configure.log"; }
  say "building in $build_dir"
  cmake --build "$build_dir"
}

# Runs a command that opens a window, with or without a screen.
with_display()
{
  xvfb-run -a -s '-screen 0 1280x1024x24 -noreset' "$@"
}

setup()
{
  [ -r /etc/debian_version ] || fail "this script sets up Debian 12; elsewhere see README.md, Building by hand"
  mkdir -p "$build_dir"
  install_packages "${build_packages[@]}" "${library_packages[@]}" "${paraview_packages[@]}" \
    "${reconstruction_packages[@]}" "${test_packages[@]}"
  unpack_pcl
  configure_and_build "$@"
}
