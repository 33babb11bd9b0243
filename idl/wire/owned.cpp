#include "idl/wire/owned.h"

#include <dds/dds.h>

namespace flexcast::wire {

void free_contents(void* sample, const dds_topic_descriptor_t& descriptor) {
  dds_sample_free(sample, &descriptor, DDS_FREE_CONTENTS);
}

}  // namespace flexcast::wire
