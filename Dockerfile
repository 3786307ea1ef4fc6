# Seiche and what it needs to run, on Debian 12 (docs/installing.md).
#   docker build -t seiche .
#   docker run --rm --user "$(id -u):$(id -g)" -v "$PWD:/work" seiche run SCENE.toml
FROM debian:12 AS build
WORKDIR /source
# Packages first: they stay in the cache as long as their list does.
COPY packages.txt ./
COPY tools/setup.sh tools/
RUN . tools/setup.sh && install_packages run package
COPY . .
RUN . tools/setup.sh && mkdir -p build && configure -DSEICHE_TESTS=OFF \
  && cmake --build build/release --target seiche -j "$(job_count)" \
  && cpack --config build/release/CPackConfig.cmake

# The package names what the program needs, so no second list can grow old.
FROM debian:12
COPY --from=build /source/build/release/packages/seiche_*.deb /packages/
RUN apt-get update \
  && DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends /packages/seiche_*.deb ffmpeg \
  && rm -rf /packages /var/lib/apt/lists/* \
  && useradd --create-home seiche && install -d -o seiche -g seiche /work
# Containers without ptrace: ranks do not read each other's memory (docs/building.md, MPI).
ENV OMPI_MCA_btl_vader_single_copy_mechanism=none
USER seiche
WORKDIR /work
ENTRYPOINT ["seiche"]
CMD ["--help"]
