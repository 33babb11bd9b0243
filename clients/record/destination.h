// Destination: the file or files a recording goes to, from the first message to the complete recording.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "clients/record/item_sink.h"
#include "clients/record/options.h"
#include "clients/record/report.h"
#include "idl/wire/frame_head.h"
#include "idl/wire/result.h"

namespace flexcast::record {

// What is known about the whole recording at the moment of the call. May be called from any thread.
using MakeReport = std::function<Report()>;

class Destination : public ItemSink {
 public:
  // When the recording has ended: writes what is still open, the metadata and the end of the file, and waits for the
  // disk. The report says what there is.
  virtual wire::Result<Report> complete() = 0;

  // After any call has failed: makes room for completing what can be kept. Gives the frames (each chunk of them) that
  // are not there any more; complete() may be called again. Fails when nothing can be completed.
  virtual wire::Result<std::vector<wire::FrameHead>> cut_back() = 0;
};

// As the options say: one file, several by size, or the newest seconds. Creates the first file.
wire::Result<std::unique_ptr<Destination>> make_destination(const Options& options, MakeReport make_report);

// Of what wire says, as the file format says it.
mcap::Status to_mcap(const wire::Result<void>& result);

// What can be said before there is anything to record: whether the output may be created.
wire::Result<void> check_output(const Options& options);

}  // namespace flexcast::record
