#!/bin/sh
# usage: sh FILE [DIRECTORY]
# Unpacks the archive of Meniscus that this file contains into DIRECTORY (default ./meniscus). Needs
# nothing but glibc, sh, tar, gzip and the coreutils. Three parts follow this text: a decompressor,
# packed by gzip; the programs, packed by xz; the meshes, packed by gzip.
set -eu
decompressor_begin=@DECOMPRESSOR_BEGIN@
decompressor_size=@DECOMPRESSOR_SIZE@
programs_begin=@PROGRAMS_BEGIN@
programs_size=@PROGRAMS_SIZE@
data_begin=@DATA_BEGIN@

case "${1:-}" in
  -h | --help)
    echo "usage: sh $0 [DIRECTORY]: unpacks into DIRECTORY (default ./meniscus), then: DIRECTORY/run"
    exit 0
    ;;
esac
folder="${1:-meniscus}"
if [ -e "$folder/run" ]; then
  echo "error: $folder already holds an archive" >&2
  exit 1
fi
mkdir -p "$folder/unpack"
tail -c "+$decompressor_begin" "$0" | head -c "$decompressor_size" | gzip -dc |
  tar -xf - -C "$folder/unpack"
tail -c "+$programs_begin" "$0" | head -c "$programs_size" |
  /lib64/ld-linux-x86-64.so.2 --library-path "$folder/unpack" "$folder/unpack/xz" -dc |
  tar -xf - -C "$folder"
tail -c "+$data_begin" "$0" | gzip -dc | tar -xf - -C "$folder"
rm -r "$folder/unpack"
if ! [ -x "$folder/run" ]; then
  echo "error: the archive could not be unpacked" >&2
  exit 1
fi
echo "unpacked; next: $folder/run report"
exit 0
