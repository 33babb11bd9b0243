// DdsCommands: the way to the servers over DDS.
#pragma once

#include "clients/web/router.h"
#include "idl/wire/reader.h"
#include "idl/wire/writer.h"

namespace flexcast::web {

class DdsCommands final : public CommandPort {
 public:
  // `replies`: read elsewhere; it must outlive this.
  DdsCommands(const wire::Participant& participant, std::string client_id, const wire::Reader<flexcast_Reply>& replies);

  bool may_command() const override { return writer_.ok(); }
  std::string error() const { return writer_ ? "" : writer_.error().message; }  // why it may not
  const std::string& client_id() const override { return client_id_; }
  bool reaches(const wire::Guid& server) override;
  wire::Result<void> write(const flexcast_Command& command) override;

 private:
  std::string client_id_;
  const wire::Reader<flexcast_Reply>& replies_;
  wire::Result<wire::Writer<flexcast_Command>> writer_;  // an error: the identity may only watch
};

// Unique: name, process, random number.
std::string make_client_id();

}  // namespace flexcast::web
