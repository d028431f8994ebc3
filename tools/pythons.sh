#!/bin/sh
# Prints the Pythons here that Blender exists for, one of each version: VERSION PATH.
seen=""
for candidate in python3.11 python3.13 python3 "$HOME"/.pyenv/versions/3.1[13].*/bin/python; do
    version=$("$candidate" -c 'import sys; print("%d.%d" % sys.version_info[:2])' 2>/dev/null) ||
        continue
    case $version in 3.11 | 3.13) ;; *) continue ;; esac
    case $seen in *"$version"*) continue ;; esac
    seen="$seen $version"
    echo "$version $candidate"
done
