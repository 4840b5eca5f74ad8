[ "$VK_DRIVER_FILES" = "$VK_ICD_FILENAMES" ] || exit 9
[ -z "$UNITVEC_DEVICE" ] || exit 9
device=$(cat "$VK_DRIVER_FILES")
case "$1 $device" in
  "devices none") echo "ERROR: f: no GPUs" >&2; exit 1 ;;
  "devices "*) exit 0 ;;
  *crash) kill -9 $$ ;;
esac
mismatches=0
[ "$device" = bad ] && mismatches=7
[ "$5 $6" = "--count 9" ] || exit 9
printf 'device\tdriver\tmismatches\n%s\tv 1\t%s\n' "$device" $mismatches > "$4"
[ $mismatches = 0 ]
