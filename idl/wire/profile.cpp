#include "idl/wire/profile.h"

#include <cstdlib>
#include <fstream>
#include <sstream>

namespace flexcast::wire {
namespace {

// Why the numbers are as they are: datagrams as large as UDP allows, so that a frame of megabytes is tens of fragments
// and not thousands; a receive buffer and a retransmit queue that hold several frames; repairs after a millisecond. The
// receive buffer has a maximum only: with a minimum above the kernel's limit (net.core.rmem_max) no participant starts.
constexpr std::string_view loopback_xml = R"(<CycloneDDS>
  <Domain Id="any">
    <General>
      <Interfaces>
        <NetworkInterface name="lo" multicast="false"/>
      </Interfaces>
      <AllowMulticast>false</AllowMulticast>
      <MaxMessageSize>65500B</MaxMessageSize>
      <FragmentSize>63000B</FragmentSize>
      <MaxRexmitMessageSize>65500B</MaxRexmitMessageSize>
    </General>
    <Discovery>
      <ParticipantIndex>auto</ParticipantIndex>
      <MaxAutoParticipantIndex>50</MaxAutoParticipantIndex>
      <LeaseDuration>5 s</LeaseDuration>
      <SPDPInterval>1 s</SPDPInterval>
      <Peers>
        <Peer address="127.0.0.1"/>
      </Peers>
    </Discovery>
    <Internal>
      <SocketReceiveBufferSize max="4MiB"/>
      <NackDelay>1 ms</NackDelay>
      <MaxQueuedRexmitBytes>64MiB</MaxQueuedRexmitBytes>
      <BurstSize>
        <MaxRexmit>4MiB</MaxRexmit>
      </BurstSize>
      <Watermarks>
        <WhcHigh>4096KiB</WhcHigh>
        <WhcHighInit>4096KiB</WhcHighInit>
        <WhcLow>1024KiB</WhcLow>
      </Watermarks>
    </Internal>
  </Domain>
</CycloneDDS>
)";

// Discovery by multicast, data by unicast: frames at full rate are more than most wireless networks carry as multicast.
constexpr std::string_view lan_xml = R"(<CycloneDDS>
  <Domain Id="any">
    <General>
      <AllowMulticast>spdp</AllowMulticast>
      <MaxMessageSize>65500B</MaxMessageSize>
      <FragmentSize>63000B</FragmentSize>
      <MaxRexmitMessageSize>65500B</MaxRexmitMessageSize>
    </General>
    <Discovery>
      <LeaseDuration>5 s</LeaseDuration>
      <SPDPInterval>1 s</SPDPInterval>
    </Discovery>
    <Internal>
      <SocketReceiveBufferSize max="4MiB"/>
      <NackDelay>1 ms</NackDelay>
      <MaxQueuedRexmitBytes>64MiB</MaxQueuedRexmitBytes>
      <BurstSize>
        <MaxRexmit>4MiB</MaxRexmit>
      </BurstSize>
      <Watermarks>
        <WhcHigh>4096KiB</WhcHigh>
        <WhcHighInit>4096KiB</WhcHighInit>
        <WhcLow>1024KiB</WhcLow>
      </Watermarks>
    </Internal>
  </Domain>
</CycloneDDS>
)";

Result<Profile> read_profile(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream content;
  if (!file || !(content << file.rdbuf())) return Error{"cannot read the profile " + path};
  std::string text = std::move(content).str();
  const std::size_t start = text.find('<');
  if (start == std::string::npos) return Error{"the profile " + path + " is not XML"};
  return Profile{path, text.substr(start)};
}

}  // namespace

Result<Profile> resolve_profile(const std::string& asked_for) {
  if (asked_for.empty()) {
    const char* uri = std::getenv("CYCLONEDDS_URI");
    if (uri && *uri) return Profile{"environment", uri};
    return Profile{"loopback", std::string(loopback_xml)};
  }
  if (asked_for == "loopback") return Profile{asked_for, std::string(loopback_xml)};
  if (asked_for == "lan") return Profile{asked_for, std::string(lan_xml)};
  if (asked_for.ends_with(".xml")) return read_profile(asked_for);
  return Error{"profile '" + asked_for + "' is unknown: loopback, lan or the path of an .xml file"};
}

std::vector<std::string_view> builtin_profiles() {
  return {"loopback", "lan"};
}

}  // namespace flexcast::wire
