#!/bin/sh
# usage: run [--driver auto|nvidia|software] [--display NAME] report [--quick] [--output DIRECTORY]
#        run [--driver ...] [--display NAME] PROGRAM [ARGUMENT]...
# Starts the report, or a program of bin/, with the libraries and the X server of this archive.
# auto, the default, takes NVIDIA's driver if the machine has one and it works here, and otherwise
# Mesa's llvmpipe. --display NAME uses an X server of the machine and its OpenGL driver instead,
# which is the way to an AMD or Intel card.
set -eu
here="$(cd "$(dirname "$0")" && pwd)"
loader=/lib64/ld-linux-x86-64.so.2
driver=auto
display=
host_path="${LD_LIBRARY_PATH:-}"

fail()
{
  echo "error: $*" >&2
  exit 1
}

usage()
{
  cat << END
usage: run [--driver auto|nvidia|software] [--display NAME] report [--quick] [--output DIRECTORY]
       run [--driver ...] [--display NAME] PROGRAM [ARGUMENT]...
programs: $(cd "$here/bin" && echo *)
END
}

while [ $# -gt 0 ]; do
  case "$1" in
    --driver | --display)
      [ $# -ge 2 ] || fail "$1 needs a value"
      [ "$1" = --driver ] && driver="$2" || display="$2"
      shift 2
      ;;
    -h | --help) usage; exit 0 ;;
    *) break ;;
  esac
done
[ $# -ge 1 ] || { usage >&2; exit 2; }
case "$driver" in auto | nvidia | software) ;; *) fail "unknown driver $driver" ;; esac

scratch="$(mktemp -d)"
server=
# Called by the trap below.
finish()
{
  unset LD_LIBRARY_PATH
  [ -z "$server" ] || kill "$server" 2> /dev/null || true
  rm -rf "$scratch"
}
trap finish EXIT
trap 'exit 130' INT TERM

# The server gets its libraries from the loader, not from the environment: it starts the machine's
# shell, which must find the machine's libraries. Its path to xkbcomp is relative (see
# scripts/bundle).
start_server()
{
  : > "$scratch/display"
  (cd "$here" && LIBGL_DRIVERS_PATH="$here/mesa/dri" exec "$loader" \
    --library-path "$here/lib:$here/gcc:$here/mesa:$here/x11/lib" "$here/x11/Xvfb" \
    -displayfd 3 -screen 0 1280x1024x24 -noreset -nolisten tcp -xkbdir "$here/x11/xkb" \
    3> "$scratch/display" > "$scratch/server.log" 2>&1) &
  server=$!
  waited=0
  until [ -s "$scratch/display" ]; do
    kill -0 "$server" 2> /dev/null || { cat "$scratch/server.log" >&2; fail "Xvfb has ended"; }
    [ "$waited" -lt 600 ] || fail "Xvfb does not start"
    sleep 0.1
    waited=$((waited + 1))
  done
  read -r number < "$scratch/display"
  DISPLAY=":$number"
  export DISPLAY
}

# The machine's libstdc++, where it is newer than the one carried: a driver of the machine may need
# it, and newer ones serve older programs.
gcc_folder()
{
  carried="$(readlink -f "$here/gcc/libstdc++.so.6")"
  for library in /usr/lib/x86_64-linux-gnu/libstdc++.so.6 /usr/lib64/libstdc++.so.6 \
    /lib/x86_64-linux-gnu/libstdc++.so.6 /usr/lib/libstdc++.so.6; do
    [ -e "$library" ] || continue
    found="$(readlink -f "$library")"
    if [ "${found##*.}" -gt "${carried##*.}" ] 2> /dev/null; then
      dirname "$library"
      return 0
    fi
  done
  echo "$here/gcc"
}

use_machine_driver()
{
  unset LIBGL_DRIVERS_PATH LIBGL_ALWAYS_SOFTWARE __GLX_VENDOR_LIBRARY_NAME GALLIUM_DRIVER
  newer="$(gcc_folder)"
  # The carried libraries come before all of the machine's in the folder of a newer libstdc++.
  LD_LIBRARY_PATH="$here/lib:$newer${host_path:+:$host_path}"
  export LD_LIBRARY_PATH
}

use_nvidia()
{
  use_machine_driver
  __GLX_VENDOR_LIBRARY_NAME=nvidia
  export __GLX_VENDOR_LIBRARY_NAME
}

use_software()
{
  LD_LIBRARY_PATH="$here/lib:$here/gcc:$here/mesa"
  LIBGL_DRIVERS_PATH="$here/mesa/dri"
  LIBGL_ALWAYS_SOFTWARE=1
  GALLIUM_DRIVER=llvmpipe
  __GLX_VENDOR_LIBRARY_NAME=mesa
  export LD_LIBRARY_PATH LIBGL_DRIVERS_PATH LIBGL_ALWAYS_SOFTWARE GALLIUM_DRIVER
  export __GLX_VENDOR_LIBRARY_NAME
}

# renderer: prints GL_RENDERER; nothing if no window can be opened.
renderer()
{
  "$here/bin/meniscus_benchmark_volume" --device 2> "$scratch/device.err" |
    while IFS= read -r line; do
      case "$line" in "GL_RENDERER: "*) echo "${line#GL_RENDERER: }" ;; esac
    done
}

has_nvidia()
{
  [ -e /proc/driver/nvidia/version ] || [ -e /dev/nvidiactl ]
}

choose_driver()
{
  if [ -n "$display" ]; then
    DISPLAY="$display"
    export DISPLAY
    use_machine_driver
    reason="that of the machine's display $display"
    return 0
  fi
  start_server
  if [ "$driver" = nvidia ] || { [ "$driver" = auto ] && has_nvidia; }; then
    use_nvidia
    name="$(renderer)" || name=
    case "$name" in
      "" | *llvmpipe* | *softpipe*) ;;
      *)
        reason="NVIDIA's, found on the machine"
        return 0
        ;;
    esac
    [ "$driver" = auto ] || fail "NVIDIA's driver opens no window: $(cat "$scratch/device.err")"
    use_software
    reason="llvmpipe: NVIDIA's driver is on the machine but opens no window under Xvfb"
    return 0
  fi
  use_software
  reason="llvmpipe: the machine has no driver by NVIDIA"
  [ "$driver" = auto ] || reason="llvmpipe, as requested"
}

choose_driver
echo "OpenGL driver: $reason" >&2
[ -d "$here/data" ] && MENISCUS_DATA_DIR="${MENISCUS_DATA_DIR:-$here/data}" ||
  MENISCUS_DATA_DIR="${MENISCUS_DATA_DIR:-/nonexistent}"
export MENISCUS_DATA_DIR
program="$1"
shift
status=0
if [ "$program" = report ]; then
  "$here/bin/meniscus_report" --programs "$here/bin" --data "$MENISCUS_DATA_DIR" \
    --about "$here/ABOUT" --driver "$reason" "$@" || status=$?
else
  [ -x "$here/bin/$program" ] || fail "there is no program $program; run --help lists them"
  "$here/bin/$program" "$@" || status=$?
fi
exit "$status"
