// What flexcast-export says of what it has written.
#pragma once

#include <string>

#include "clients/export/exporter.h"

namespace flexcast::exporting {

// "drop/run.pvd: 120 frames, 121 files, 3.412 MB"
std::string to_text(const Summary& summary);

// One object: file, run, run_id, frames, files, bytes, output, fields, missing [{first, last}], incomplete.
std::string to_json(const Summary& summary, const Selection& selection, const std::string& file);

// "3 frames are missing in the recording: 4, 10-11"; "" when none is. Long lists are cut.
std::string missing_text(const Selection& selection, const Summary& summary);

}  // namespace flexcast::exporting
