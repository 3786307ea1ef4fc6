# shellcheck shell=sh
# Shared by ./demo and ./check: packages, environment, build. Source it from the top folder; do not run it.

say() { printf '\n== %s\n' "$*"; }
note() { printf '   %s\n' "$*"; }

# packages SECTION...: names in these sections of packages.txt.
packages() {
  awk -v wanted=" $* " '
    { sub(/#.*/, ""); gsub(/[ \t]+/, "") }
    /^\[/ { gsub(/[][]/, ""); inside = index(wanted, " " $0 " "); next }
    inside && NF' packages.txt
}

missing_packages() {
  for name in $(packages "$@"); do
    [ "$(dpkg-query -W -f='${db:Status-Status}' "$name" 2>/dev/null)" = installed ] || printf '%s ' "$name"
  done
}

# Runs a command as root and prints it.
as_root() {
  [ "$(id -u)" -eq 0 ] || set -- sudo "$@"
  note "running: $*"
  "$@" </dev/null
}

require_root() {
  if [ "$(id -u)" -ne 0 ] && ! command -v sudo >/dev/null; then
    note "that needs root, and there is no sudo; run this as root and start again:"
    note "  apt-get install --no-install-recommends $*"
    exit 5
  fi
}

# install_packages SECTION...: installs missing packages only.
install_packages() {
  if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    note "no apt here: the equivalents of packages.txt are taken to be installed"
    return
  fi
  absent=$(missing_packages "$@")
  [ -n "$absent" ] || { note "all there"; return; }
  note "missing: $absent"
  require_root "$absent"
  as_root apt-get update -q || note "apt-get update had errors; trying with the lists that are there"
  # shellcheck disable=SC2086
  as_root env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends \
    -o DPkg::Lock::Timeout=300 -o Dpkg::Use-Pty=0 $absent
}

# Cores available to this process, without hyper-threads, as mpirun counts them.
core_count() {
  allowed=$(nproc)
  physical=$(lscpu -p=CORE,SOCKET 2>/dev/null | grep -v '^#' | sort -u | wc -l)
  if [ "$physical" -gt 0 ] && [ "$physical" -lt "$allowed" ]; then echo "$physical"; else echo "$allowed"; fi
}

# Number of parallel compilers: one a core, with 2 GB of memory each.
job_count() {
  memory=$(awk '/^MemAvailable/ { print int($2 / 2000000) }' /proc/meminfo)
  cores=$(nproc)
  if [ "$memory" -ge "$cores" ]; then echo "$cores"; elif [ "$memory" -ge 1 ]; then echo "$memory"; else echo 1; fi
}

# Open MPI as root, in containers, and beside other runs. Without a named messaging layer each start looks for networks
# for 0.2 s.
mpi_environment() {
  if [ "$(id -u)" -eq 0 ]; then
    export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
  fi
  export OMPI_MCA_btl_vader_single_copy_mechanism="${OMPI_MCA_btl_vader_single_copy_mechanism:-none}"
  export OMPI_MCA_pml="${OMPI_MCA_pml:-ob1}"
  export OMPI_MCA_hwloc_base_binding_policy="${OMPI_MCA_hwloc_base_binding_policy:-none}"
}

# configure OPTION...: configures the release preset with these options, and with ccache if installed.
configure() {
  launcher=$(command -v ccache || true)
  export CCACHE_SLOPPINESS="${CCACHE_SLOPPINESS:-pch_defines,time_macros}"  # else it passes precompiled headers by
  cmake --preset release -DCMAKE_CXX_COMPILER_LAUNCHER="$launcher" "$@" >build/configure.log 2>&1 ||
    { cat build/configure.log; exit 1; }
}
