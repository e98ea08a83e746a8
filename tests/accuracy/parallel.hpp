/* SPDX-License-Identifier: Apache-2.0 */
/* A loop whose turns do not depend on one another, on several threads. */
#pragma once

#include <cstddef>
#include <functional>

namespace accuracy {

/* Calls body(i) for every i < count, in no fixed order; 0 threads: as many as the machine has. 'progress' is called with
 * done and total, from one thread at a time. The first exception stops the loop and is thrown again. */
void parallel_for(size_t count, int threads, const std::function<void(size_t)> &body,
                  const std::function<void(size_t, size_t)> &progress);

} // namespace accuracy
