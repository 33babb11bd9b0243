// Child: this program once more as a subscriber in a process of its own. Parent and child talk in lines: commands go to
// its standard input, answers come from its standard output. It ends with this object.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace flexcast::bench {

class Child {
 public:
  // `program`: "/proc/self/exe" or a name to be looked up in PATH. Ends the bench when it cannot be started.
  Child(const std::string& program, const std::vector<std::string>& arguments);
  ~Child();
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  void tell(const std::string& line) const;
  std::string hear();      // the next line; "" when it has ended
  std::string hear_all();  // up to its end

  void signal(int number) const;
  pid_t pid() const { return pid_; }

 private:
  pid_t pid_ = 0;
  int to_ = -1, from_ = -1;
  std::string heard_;
};

}  // namespace flexcast::bench
