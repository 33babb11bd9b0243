// Client: a client of one world on eProsima's Fast DDS. It knows flexcast by its IDL and idl/README.md alone.
#pragma once

#include <flexcastPubSubTypes.h>

#include <chrono>
#include <cstdint>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace flexcast_fastdds {

namespace dds = eprosima::fastdds::dds;
using Duration = std::chrono::steady_clock::duration;

class Client {
 public:
  // Joins the domain on 127.0.0.1 alone. Throws when something cannot be created.
  Client(int domain, std::string world);
  ~Client();
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  // Waits until frames, replies and commands have found the server.
  bool wait_for_match(Duration timeout);

  // Sends a command and waits for its reply; the world and the numbers are filled in.
  std::optional<flexcast::Reply> send(flexcast::Command command, Duration timeout);

  // The frames that have arrived since; waits until there is one.
  std::vector<flexcast::ParticleFrame> take_frames(Duration timeout);

 private:
  template <class Type>
  dds::Topic* add_topic(const char* name);
  template <class Type>
  dds::DataReader* add_reader(const char* name, int depth);
  template <class Type>
  dds::DataWriter* add_writer(const char* name, int depth);

  std::string world_;
  std::string client_id_;
  std::uint64_t last_request_ = 0;
  dds::DomainParticipant* participant_ = nullptr;  // owns all below; the destructor deletes it
  dds::Subscriber* subscriber_ = nullptr;
  dds::Publisher* publisher_ = nullptr;
  dds::DataReader* frames_ = nullptr;
  dds::DataReader* replies_ = nullptr;
  dds::DataWriter* commands_ = nullptr;
};

}  // namespace flexcast_fastdds
