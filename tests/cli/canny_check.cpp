/* SPDX-License-Identifier: Apache-2.0 */
/* Is an edge map the one that cv::Canny makes of an image?
 *
 * usage: canny_check IMAGE.png EDGES.png LOW HIGH SMOOTH   thresholds as for cv::Canny, SMOOTH 0 or 1 */
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <cstdlib>
#include <iostream>
#include <string>

int main(int argc, char **argv)
{
    if (argc != 6) {
        std::cerr << "usage: canny_check IMAGE.png EDGES.png LOW HIGH SMOOTH\n";
        return EXIT_FAILURE;
    }
    cv::Mat image = cv::imread(argv[1], cv::IMREAD_UNCHANGED);
    const cv::Mat edges = cv::imread(argv[2], cv::IMREAD_UNCHANGED);
    if (image.type() != CV_8U || edges.type() != CV_8U || image.size() != edges.size()) {
        std::cerr << "canny_check: the two are not 8-bit grey images of one size\n";
        return EXIT_FAILURE;
    }
    if (std::string(argv[5]) == "1") {
        cv::GaussianBlur(image, image, cv::Size(5, 5), 0);
    }
    cv::Mat expected;
    cv::Canny(image, expected, std::stod(argv[3]), std::stod(argv[4]), 3, false);
    const int wrong = cv::countNonZero(expected != edges);
    std::cout << cv::countNonZero(expected) << " edge points expected, " << wrong << " pixels wrong\n";
    return wrong == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
