/* SPDX-License-Identifier: Apache-2.0 */
/* Threads that take the next turn of a loop until none is left. */
#include "parallel.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include <opencv2/core.hpp>

namespace accuracy {

void parallel_for(size_t count, int threads, const std::function<void(size_t)> &body,
                  const std::function<void(size_t, size_t)> &progress)
{
    std::atomic<size_t> next{0};
    std::exception_ptr failure;
    std::mutex mutex;
    size_t done = 0;
    const auto work = [&] {
        for (size_t i = next++; i < count; i = next++) {
            try {
                body(i);
                const std::lock_guard<std::mutex> lock(mutex);
                done++;
                if (progress) {
                    progress(done, count);
                }
            } catch (...) {
                const std::lock_guard<std::mutex> lock(mutex);
                failure = std::current_exception();
                next = count;
            }
        }
    };
    cv::setNumThreads(1); /* the loop has the processors */
    std::vector<std::thread> pool;
    const unsigned wanted =
        threads > 0 ? static_cast<unsigned>(threads) : std::max(1u, std::thread::hardware_concurrency());
    for (unsigned i = 0; i < wanted; i++) {
        pool.emplace_back(work);
    }
    for (std::thread &t : pool) {
        t.join();
    }
    if (failure) {
        std::rethrow_exception(failure);
    }
}

} // namespace accuracy
