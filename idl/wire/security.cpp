#include "idl/wire/security.h"

#include <dlfcn.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <optional>

namespace flexcast::wire {
namespace {

namespace fs = std::filesystem;

struct File {
  const char* property;
  const char* name;
};

constexpr std::array files{
    File{"dds.sec.auth.identity_ca", "identity_ca.pem"},
    File{"dds.sec.auth.identity_certificate", "cert.pem"},
    File{"dds.sec.auth.private_key", "key.pem"},
    File{"dds.sec.access.governance", "governance.p7s"},
    File{"dds.sec.access.permissions_ca", "permissions_ca.pem"},
    File{"dds.sec.access.permissions", "permissions.p7s"},
};

struct Plugin {
  const char* properties;  // the beginning of their names
  const char* library;
  const char* functions;  // the end of their names
};

constexpr std::array plugins{
    Plugin{"dds.sec.auth.library.", "libdds_security_auth.so", "authentication"},
    Plugin{"dds.sec.access.library.", "libdds_security_ac.so", "access_control"},
    Plugin{"dds.sec.crypto.library.", "libdds_security_crypto.so", "crypto"},
};

bool is_readable(const fs::path& path) {
  std::error_code ignored;
  return !fs::is_directory(path, ignored) && std::ifstream(path).good();
}

// The folder that Cyclone was loaded from.
fs::path library_folder() {
  Dl_info info{};
  if (dladdr(reinterpret_cast<const void*>(&dds_create_participant), &info) == 0 || !info.dli_fname) return {};
  return fs::path(info.dli_fname).parent_path();
}

// Debian keeps the plugins in a folder below; Cyclone's own installation puts them beside its library.
std::optional<fs::path> find_plugin(const char* library) {
  for (const fs::path& folder : {library_folder() / "libddsc0debian", library_folder()})
    if (is_readable(folder / library)) return folder / library;
  return {};
}

// The plugins come with Debian's package of Cyclone DDS; a Cyclone built by hand may lack them.
Error missing_plugin(const char* library) {
  const std::string folder = library_folder().string();
  return Error{"the plugin " + std::string(library) + " of Cyclone DDS is neither in " + folder +
               "/libddsc0debian nor in " + folder};
}

}  // namespace

Result<DdsQos> make_security_qos(const std::string& folder) {
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) return Error{"there is no folder " + folder + " with an identity"};
  DdsQos qos(dds_create_qos());
  for (const File& file : files) {
    const fs::path path = fs::absolute(folder, ignored) / file.name;
    if (!is_readable(path))
      return Error{"the identity in " + folder + " lacks " + file.name + ", or it cannot be read"};
    dds_qset_prop(qos.get(), file.property, ("file:" + path.string()).c_str());
  }
  for (const Plugin& plugin : plugins) {
    const auto library = find_plugin(plugin.library);
    if (!library) return missing_plugin(plugin.library);
    const std::string properties = plugin.properties;
    dds_qset_prop(qos.get(), (properties + "path").c_str(), library->c_str());
    dds_qset_prop(qos.get(), (properties + "init").c_str(), (std::string("init_") + plugin.functions).c_str());
    dds_qset_prop(qos.get(), (properties + "finalize").c_str(), (std::string("finalize_") + plugin.functions).c_str());
  }
  return qos;
}

}  // namespace flexcast::wire
