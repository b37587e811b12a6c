# Shell functions shared by the set-up steps; sourced, never run.
# shellcheck shell=bash

say()  { printf '\n== %s\n' "$*" >&2; }
note() { printf '   %s\n' "$*" >&2; }
die()  { printf '\nerror: %s\n' "$*" >&2; exit 1; }

# The folder that holds what is built once and shared by all checkouts.
cache_dir() { printf '%s/yade-nonsmooth' "${XDG_CACHE_HOME:-$HOME/.cache}"; }

as_root() {
    if [ "$(id -u)" -eq 0 ]; then "$@"
    elif command -v sudo >/dev/null 2>&1; then sudo "$@"
    else die "'$*' needs root, and there is no sudo: run it as root once, then call this again"
    fi
}

# Turns ninja's "[done/total] …" lines into a bar with the time left: one line rewritten on a terminal,
# one line per 30 s in a log. Ticks on between ninja's lines, for a step can take a minute.
# (Bash, not awk: Debian's awk reads a pipe in large blocks, so the bar would stand still.)
ninja_progress() {
    local log=$1 start=$SECONDS printed=-60 shown="" every=30 end="\n" begin="" line status done=0 total=0
    [ -t 2 ] && every=1 end="" begin="\r"
    : >"$log"
    while true; do
        status=0
        IFS= read -r -t 1 line || status=$?
        if [ "$status" -eq 0 ]; then
            printf '%s\n' "$line" >>"$log"
            [[ $line =~ ^\[([0-9]+)/([0-9]+)\] ]] && done=${BASH_REMATCH[1]} total=${BASH_REMATCH[2]}
        elif [ "$status" -le 128 ]; then # the end, not the time-out of read
            [ -z "$shown" ] || progress_line >&2
            [ -z "$shown" ] || [ -z "$begin" ] || printf '\n' >&2
            return 0
        fi
        # nothing is shown of what takes no time
        if [ "$total" -gt 0 ] && [ $((SECONDS - start)) -ge 3 ] && [ $((SECONDS - printed)) -ge "$every" ]; then
            printed=$SECONDS shown=yes
            progress_line >&2
        fi
    done
}

# One line of ninja_progress, from its local variables.
progress_line() {
    local spent=$((SECONDS - start)) filled=$((30 * done / total)) left="" bar
    bar=$(printf '%*s' "$filled" '' | tr ' ' '#')$(printf '%*s' $((30 - filled)) '' | tr ' ' '.')
    # the first steps are often the short ones: no estimate from them
    if [ "$done" -gt 1 ] && [ "$done" -lt "$total" ] && [ "$spent" -ge 30 ]; then
        left=$((spent * (total - done) / done))
        left=$(printf ', about %d:%02d left' $((left / 60)) $((left % 60)))
    fi
    # shellcheck disable=SC2059
    printf "$begin   [%s] %d/%d, %d:%02d spent%s   $end" "$bar" "$done" "$total" $((spent / 60)) $((spent % 60)) "$left"
}
