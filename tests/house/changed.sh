# Defines changed_sources, which lists the sources and headers that the last commit or the working tree changed, or that
# differ from SPRUNG_LINT_BASE. Ends the script that reads it, as skipped, if there is no such commit: in a shallow clone.
changed_sources() {
  local sources=('core/*.cpp' 'core/*.h' 'render/*.cpp' 'render/*.h' 'app/*.cpp' 'app/*.h')
  git diff --name-only --diff-filter=d "${SPRUNG_LINT_BASE:-HEAD~1}" -- "${sources[@]}"
  git ls-files --others --exclude-standard -- "${sources[@]}"
}
git rev-parse --quiet --verify "${SPRUNG_LINT_BASE:-HEAD~1}" >/dev/null || exit 77
