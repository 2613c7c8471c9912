#include "transport/batch.cl"

// Each work-item takes the paths of batch `first_batch` + its number, in lanes that become idle as given by `words`.
__kernel void take_batches(int pixel_count, int first_pixel, int job_count, int first_sample, int block_samples,
                           int batch_jobs, __global const Uint* words, int word_count, __global int* pixels,
                           __global int* samples, __global int* times) {
  const JobList list = {pixel_count, first_pixel, job_count, first_sample, block_samples};
  const int index = (int)get_global_id(0);
  if (index >= batch_count(list, batch_jobs)) return;
  Batch batch = batch_at(list, batch_jobs, index);
  const int first_path = index * batch_jobs * block_samples;
  Int path = (Int)(-1);
  for (int step = 0; batch.next < batch.path_count; ++step) {
    const Mask idle = (words[step % word_count] & 1u) != 0u;
    const Int before = path;
    const Mask taken = take_paths(&batch, &path, idle);
    RandomSequence sequence;
    find_path(list, &batch, path, &sequence);
    scatter_int(pixels, first_path + path, uint_to_int(sequence.pixel), taken);
    scatter_int(samples, first_path + path, uint_to_int(sequence.sample), taken);
    const Int so_far = gather_int(times, taken ? first_path + path : (Int)(first_path));
    scatter_int(times, first_path + path, so_far + 1, taken);
    // Lanes that took no path keep theirs.
    const Mask lost = (!taken) & (path != before);
    if (any_lane(lost)) times[first_path] = -1000;
  }
}
