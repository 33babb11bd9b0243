// How the memory of samples is handled, for programs that send or receive frames.
#pragma once

namespace flexcast::wire {

// Lets this process keep what it frees, in every thread. Cyclone gets the memory of each sample anew; by default
// blocks from 128 KiB on go back to the system at once, and the next frame pays for every page of them. To be called
// once, before the first frame: it is for the whole process, so libraries leave it to their users.
void keep_freed_memory();

}  // namespace flexcast::wire
