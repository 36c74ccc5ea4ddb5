// Which program this is.
#pragma once

namespace tanktread::driver {

/// "0.1.0", from CMakeLists.txt.
extern const char* const version;

/// The commit it was built from: "248c18c6a8"; "248c18c6a8+" if tracked files differed from it; "unknown" if
/// it was built outside a checkout.
extern const char* const commit;

}  // namespace tanktread::driver
