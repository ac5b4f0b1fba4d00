# The sources and headers that the last commit or the working tree changed, or that differ from SPRUNG_LINT_BASE. Ends
# the script that asks, as skipped, where there is no such commit: in a shallow clone.
changed_sources() {
  git diff --name-only --diff-filter=d "${SPRUNG_LINT_BASE:-HEAD~1}" -- 'core/*.cpp' 'core/*.h' 'render/*.cpp' 'render/*.h' 'app/*.cpp' 'app/*.h'
  git ls-files --others --exclude-standard -- 'core/*.cpp' 'core/*.h' 'render/*.cpp' 'render/*.h' 'app/*.cpp' 'app/*.h'
}
git rev-parse --quiet --verify "${SPRUNG_LINT_BASE:-HEAD~1}" >/dev/null || exit 77
