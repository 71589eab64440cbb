#!/bin/bash
# Run one stage of the tests: tools/stage.sh FOLDER NAME COMMAND...
# Its output goes to FOLDER/NAME.log; one line tells the result and the seconds, and the log follows if the stage failed.
set -u
folder=$1 name=$2
shift 2
mkdir -p "$folder"
log=$folder/$name.log
start=$(date +%s%N)
"$@" >"$log" 2>&1
status=$?
printf -v line '%-4s %-28s %6.1f s' "$([ $status = 0 ] && echo ok || echo FAIL)" "$name" "$((($(date +%s%N) - start) / 1000000))e-3"
echo "$line"
if [ $status != 0 ]; then
    echo "---- $log (the last 200 lines)"
    tail -n 200 "$log"
    echo "---- $name failed with status $status: $*"
fi
exit $status
