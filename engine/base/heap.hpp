#pragma once
// The heap of a process that runs one job: small buffers stay in it, where the next one finds them; columns of long
// recordings go back to the system as soon as nobody holds them (glibc would move its limit above them after the
// first).
//
// Requires   called before the process works; glibc, elsewhere nothing happens
// Not for    a diagnosis, which asks for matrices of megabytes thousands of times: keep_heap()
// Measured   pages of 2 MB, and what lies before the first of them at once: 1.4 of 20 ms (n = 1e4). A page of 4 KB
//            costs its first write as much as two thousand numbers. A part of the heap that is never used is never
//            there, but of what is freed so much stays. 12 MB instead of 6: 1.3 ms of 20 (1e4) and 3.8 of 42 (1e5);
//            with what long columns leave given back 2 MB more at 1e6, else 4

namespace torquescope {

void prepare_heap();

// of a diagnosis: what it lets go of stays in the heap, where the next matrix finds it (measured: a third of its time)
void keep_heap();

// where columns are so long that they have memory of their own: what they left in the heap goes back, too
void give_back_holes();

}  // namespace torquescope
