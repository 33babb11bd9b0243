// Security: an identity for DDS Security, read from a folder. Internal to idl/wire.
//
//   identity_ca.pem      the authority that signs certificates
//   permissions_ca.pem   the authority that signs the two below
//   cert.pem, key.pem    who we are
//   governance.p7s       the rules of the domain, the same for all who shall meet
//   permissions.p7s      what this identity may read and write
//
// server/security/make_identities.sh makes such folders. Cyclone's security plugins (authentication, access control,
// cryptography) are libraries of their own, looked for where the library of Cyclone itself is.
#pragma once

#include <string>

#include "idl/wire/qos_convert.h"
#include "idl/wire/result.h"

namespace flexcast::wire {

// The QoS of a participant with the identity in `folder`. The error names the file or plugin that is missing or cannot
// be read; what the files say is for Cyclone to judge.
Result<DdsQos> make_security_qos(const std::string& folder);

}  // namespace flexcast::wire
