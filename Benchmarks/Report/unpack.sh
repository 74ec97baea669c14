#!/bin/sh
# usage: sh FILE [DIRECTORY]
# Unpacks the archive of Meniscus that this file contains into DIRECTORY (default ./meniscus). Needs
# nothing but glibc, sh, tar, gzip and the coreutils. Four parts follow this text: a decompressor,
# packed by gzip; libraries and programs, packed by xz; meshes, packed by gzip.
set -eu
begin=@BEGIN@
decompressor=@DECOMPRESSOR@
system=@SYSTEM@
programs=@PROGRAMS@
data=@DATA@

case "${1:-}" in
  -h | --help)
    echo "usage: sh $0 [DIRECTORY]: unpacks into DIRECTORY (default ./meniscus)"
    echo "next: DIRECTORY/run --help"
    exit 0
    ;;
esac
archive="$0"
folder="${1:-meniscus}"
if [ -e "$folder/run" ]; then
  echo "error: $folder already holds an archive" >&2
  exit 1
fi
mkdir -p "$folder/unpack"

# part SIZE: writes the next part to standard output.
part()
{
  tail -c "+$begin" "$archive" | head -c "$1"
}

# unxz: with the carried decompressor.
unxz()
{
  /lib64/ld-linux-x86-64.so.2 --library-path "$folder/unpack" "$folder/unpack/xz" -dc
}

part "$decompressor" | gzip -dc | tar -xf - -C "$folder/unpack"
begin=$((begin + decompressor))
part "$system" | unxz | tar -xf - -C "$folder"
begin=$((begin + system))
part "$programs" | unxz | tar -xf - -C "$folder"
begin=$((begin + programs))
part "$data" | gzip -dc | tar -xf - -C "$folder"
rm -r "$folder/unpack"
if ! [ -x "$folder/run" ]; then
  echo "error: the archive could not be unpacked" >&2
  exit 1
fi
echo "unpacked; next: $folder/run report"
exit 0
