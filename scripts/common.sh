# Shell functions shared by the scripts of this folder. Source it; it changes to the project's root.
# shellcheck shell=bash

ROOT="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
cd "$ROOT"
JOBS="${MENISCUS_JOBS:-$(nproc)}"
export DEBIAN_FRONTEND=noninteractive
# The compiler cache serves all clones: paths below the root count relative to the build folder, and
# the folder's own name does not count.
export CCACHE_BASEDIR="${CCACHE_BASEDIR:-$ROOT}"
export CCACHE_NOHASHDIR="${CCACHE_NOHASHDIR:-1}"

# Packages that a fresh Debian 12 lacks, per purpose. The first compile the kernel's objects; all
# that links them needs OpenMesh.
PACKAGES_KERNEL=(g++ cmake ninja-build libglm-dev)
PACKAGES_TESTS=(python3 python3-numpy libpython3-dev libgtest-dev libbenchmark-dev)
PACKAGES_BUILD=("${PACKAGES_KERNEL[@]}" "${PACKAGES_TESTS[@]}" libopenmesh-dev libvtk9-dev
  python3-vtk9)
# Needed by a part of the benchmarks only; the build works without it.
PACKAGES_BENCHMARKS=(libembree-dev)
# TetGen, under the AGPL: for MENISCUS_WITH_TETGEN.
PACKAGES_TETGEN=(libtet1.5-dev)
PACKAGES_DISPLAY=(xvfb xauth libgl1-mesa-dri)
PACKAGES_LINT=(clang-format-14 codespell flake8 git)
PACKAGES_DOCS=(doxygen python3)
# Validates the shaders, without a graphics device.
PACKAGES_SHADERS=(glslang-tools)
PACKAGES_TIDY=(clang-tidy-14)
# The second compiler.
PACKAGES_CLANG=(clang-14)
# libFuzzer is among the run-time libraries; llvm-14 has the symbolizer.
PACKAGES_FUZZ=(clang-14 libclang-rt-14-dev llvm-14)
# The page of `meniscus --web` in a browser.
PACKAGES_WEB=(chromium chromium-driver python3-venv python3-numpy python3-pil)
# Pictures to compare with; its include files are not needed.
PACKAGES_POVRAY=(povray)
# paraview-dev does not declare all packages that its CMake files look for; python3-paraview
# conflicts with python3-vtk9 and is unpacked by scripts/paraview-prefix instead.
PACKAGES_PARAVIEW=(paraview paraview-dev libutfcpp-dev libpng-dev libx11-dev libopenmpi-dev
  openmpi-bin libgl-dev libopengl-dev libglew-dev libfreetype-dev libjpeg-dev liblz4-dev liblzma-dev
  libtiff-dev libdouble-conversion-dev libexpat1-dev libxml2-dev zlib1g-dev libpython3-dev
  libhdf5-mpi-dev libnetcdf-dev)

say()
{
  printf '\n== %s\n' "$*"
}

die()
{
  printf 'error: %s\n' "$*" >&2
  exit 1
}

# as_root COMMAND...: runs it as root, through sudo only if this is a plain user.
as_root()
{
  if [ "$(id -u)" -eq 0 ]; then
    "$@"
  elif command -v sudo > /dev/null; then
    sudo "$@"
  else
    die "root is needed for: $* (no sudo here; run this command as root and start again)"
  fi
}

# missing_packages NAME...: prints those that are not installed.
missing_packages()
{
  local package
  for package in "$@"; do
    if [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2> /dev/null)" != installed ]; then
      printf '%s\n' "$package"
    fi
  done
}

update_package_lists()
{
  if [ -z "${MENISCUS_APT_UPDATED:-}" ]; then
    as_root apt-get update -q
    export MENISCUS_APT_UPDATED=1
  fi
}

# install_packages NAME...: installs missing packages; does nothing if there are none.
install_packages()
{
  local missing
  mapfile -t missing < <(missing_packages "$@")
  if [ "${#missing[@]}" -eq 0 ]; then
    return 0
  fi
  command -v apt-get > /dev/null ||
    die "apt-get not found; install the equivalents of: ${missing[*]}"
  say "Installing ${missing[*]}"
  update_package_lists
  # As Debian's installer does, without waiting for the disk after each package.
  as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends \
    -o Dpkg::Options::=--force-unsafe-io "${missing[@]}"
}

# configure PRESET [CMAKE-ARGUMENT...]
configure()
{
  local preset="$1"
  shift
  local launcher=()
  if command -v ccache > /dev/null; then
    launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
  fi
  say "Configuring preset $preset"
  cmake --preset "$preset" "${launcher[@]}" "$@"
}

# build PRESET [CMAKE-ARGUMENT...]
build()
{
  local preset="$1"
  shift
  say "Building preset $preset"
  cmake --build --preset "$preset" --parallel "$JOBS" "$@"
}

configure_and_build()
{
  configure "$@"
  build "$1"
}

# name_instruction_set: the set of MENISCUS_INSTRUCTION_SETS that this processor uses.
name_instruction_set()
{
  case "$(uname -m)" in
    x86_64)
      if grep -q -w avx512f /proc/cpuinfo; then
        echo AVX512
      elif grep -q -w avx2 /proc/cpuinfo; then
        echo AVX2
      else
        echo Portable
      fi ;;
    *) echo '.*' ;;
  esac
}

# Options of CMake for the kernel; without one, a build folder keeps its instruction sets.
KERNEL_OPTIONS=()

# install_packages_and_kernel PACKAGE...: builds the kernel, which knows no VTK, in build-kernel
# while the packages are being installed.
install_packages_and_kernel()
{
  local kernel
  install_packages "${PACKAGES_KERNEL[@]}"
  configure kernel "${KERNEL_OPTIONS[@]}" > /dev/null
  build kernel > build-kernel/build.log 2>&1 &
  kernel="$!"
  install_packages "$@"
  say "Building the kernel"
  wait "$kernel" || { cat build-kernel/build.log >&2; die "the kernel cannot be built"; }
}
# Makes a build use that kernel.
WITH_KERNEL="-DMENISCUS_KERNEL_BUILD=$ROOT/build-kernel"

# with_display COMMAND...: VTK 9.1 and ParaView need an X display, also off screen. Without
# -noreset the server starts anew whenever its last client leaves, and refuses those who come then.
# Mesa's software rasteriser compiles a shader in half of the time if LLVM does not optimise it,
# which takes longer than drawing pictures of the size of tests.
with_display()
{
  GALLIVM_PERF=nopt xvfb-run -a -s "-screen 0 1280x1024x24 -noreset" "$@"
}
