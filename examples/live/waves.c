/* The same as waves.cpp, in C. Usage: waves_c [FRAMES [PORT]] */

#include <imgeo/live_c.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#define COLUMNS 128
#define ROWS 128
#define FRAMES_PER_SECOND 30

static float positions[3 * COLUMNS * ROWS];

static void compute_positions(double seconds) {
  float* at = positions;
  for (int row = 0; row < ROWS; ++row)
    for (int column = 0; column < COLUMNS; ++column) {
      const double x = 2.0 * column / (COLUMNS - 1) - 1, z = 2.0 * row / (ROWS - 1) - 1;
      *at++ = (float)x;
      *at++ = (float)(0.2 * sin(5 * x + 2 * seconds) * cos(4 * z - seconds));
      *at++ = (float)z;
    }
}

int main(int argument_count, char** arguments) {
  const int frames = argument_count > 1 ? atoi(arguments[1]) : 600 * FRAMES_PER_SECOND;
  const int port = argument_count > 2 ? atoi(arguments[2]) : 8090;
  const double box[6] = {-1, -0.25, -1, 1, 0.25, 1};
  imgeo_publisher* publisher = imgeo_publisher_create("waves", COLUMNS * ROWS, COLUMNS, box);
  imgeo_publisher_set_rate(publisher, FRAMES_PER_SECOND);
  if (imgeo_publisher_listen(publisher, "127.0.0.1", (uint16_t)port) != 0) {
    fprintf(stderr, "%s\n", imgeo_publisher_error());
    imgeo_publisher_destroy(publisher);
    return 2;
  }
  printf("%s\n", imgeo_publisher_url(publisher));
  fflush(stdout);
  for (int frame = 0; frame < frames; ++frame) {
    const struct timespec pause = {0, 1000000000 / FRAMES_PER_SECOND};
    compute_positions((double)frame / FRAMES_PER_SECOND);
    if (imgeo_publisher_publish(publisher, NAN, positions, NULL, NULL, NULL) != 0)
      fprintf(stderr, "%s\n", imgeo_publisher_error());
    nanosleep(&pause, NULL);
  }
  const imgeo_totals totals = imgeo_publisher_totals(publisher);
  printf("%llu frames, %llu bytes each\n", (unsigned long long)totals.published,
         (unsigned long long)(totals.published > 0 ? totals.bytes / totals.published : 0));
  imgeo_publisher_destroy(publisher);
  return 0;
}
