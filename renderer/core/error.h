// The one exception type that cutis throws for anything a user can cause or mend.
#pragma once

#include <stdexcept>
#include <string>

namespace cutis {

// What failed, why, and where: printed by the program as one line, `cutis: error: WHAT: why, where`.
// `where` is a file, a JSON path, an option or a device; it may be empty.
class Error : public std::runtime_error {
  public:
    Error(std::string what, std::string why, std::string where = {});

    const std::string& subject() const { return subject_; }
    const std::string& why() const { return why_; }
    const std::string& where() const { return where_; }

  private:
    std::string subject_, why_, where_;
};

// A warning that the user should read once; goes to stderr as `cutis: warning: TEXT` unless a sink is set.
void warn(const std::string& text);

using WarningSink = void (*)(const std::string& text);
// Replaces where warnings go (tests, the viewer's log); nullptr restores stderr. Returns the sink it replaced.
WarningSink setWarningSink(WarningSink sink);

}  // namespace cutis
