// Qos as Cyclone's object. Internal to idl/wire.
#pragma once

#include <dds/dds.h>

#include <memory>

#include "idl/wire/qos.h"

namespace flexcast::wire {

struct DeleteQos {
  void operator()(dds_qos_t* qos) const { dds_delete_qos(qos); }
};
using DdsQos = std::unique_ptr<dds_qos_t, DeleteQos>;

DdsQos to_dds(const Qos& qos);

}  // namespace flexcast::wire
