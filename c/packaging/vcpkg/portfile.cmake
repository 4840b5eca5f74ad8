# Builds the checkout that this port lies in: vcpkg install unitvec --overlay-ports=c/packaging/vcpkg
vcpkg_check_linkage(ONLY_STATIC_LIBRARY)
vcpkg_check_features(OUT_FEATURE_OPTIONS options FEATURES offline UNITVEC_OFFLINE)
# The library is that of Rust's release profile in any configuration.
set(VCPKG_BUILD_TYPE release)
cmake_path(SET source NORMALIZE "${CURRENT_PORT_DIR}/../..")
vcpkg_cmake_configure(SOURCE_PATH "${source}" OPTIONS ${options})
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(CONFIG_PATH lib/cmake/unitvec)
vcpkg_install_copyright(FILE_LIST "${source}/../LICENSE-MIT" "${source}/../LICENSE-APACHE")
