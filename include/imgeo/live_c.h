/**
 * @file
 * Publishing of live streams from C, and by way of it from other languages (docs/live.md). Link imgeo-live.
 *
 * Every function may be called from any thread. Those that return an int return 0, or what went wrong: 1 wrong usage,
 * 2 the address or the network, 3 a value out of its range, 4 an internal fault; imgeo_publisher_error() has the
 * sentence.
 */
#ifndef IMGEO_LIVE_C_H
#define IMGEO_LIVE_C_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** A stream and where it is published. */
typedef struct imgeo_publisher imgeo_publisher;

/** Sums over the life of a publisher. */
typedef struct imgeo_totals {
  uint64_t published; /**< frames */
  uint64_t dropped;   /**< frames that came faster than the rate or than the network carries them */
  uint64_t clamped;   /**< values outside of the box or their range */
  uint64_t bytes;     /**< of all encoded frames */
} imgeo_totals;

/**
 * A stream of `vertices` vertices, 1 .. 4,194,304, that come row by row if they are a grid of `columns` columns; 0: no
 * grid. `box` is the smallest x y z and the largest x y z. The name has 1 .. 64 of a-z A-Z 0-9 _ -. Nothing is checked
 * or published before imgeo_publisher_listen() or imgeo_publisher_connect(). NULL if there is no memory.
 */
imgeo_publisher* imgeo_publisher_create(const char* name, uint32_t vertices, uint32_t columns, const double box[6]);

/** Ends the stream. NULL is allowed. */
void imgeo_publisher_destroy(imgeo_publisher* publisher);

/*
 * What frames have. Where frames have been published, the next one begins an epoch with the new setting.
 */

/** Another number of vertices, another grid, another box. */
int imgeo_publisher_set_topology(imgeo_publisher* publisher, uint32_t vertices, uint32_t columns, const double box[6]);
/** Bits of a stored coordinate, 8..24. Without this call 16. */
int imgeo_publisher_set_bits(imgeo_publisher* publisher, uint32_t bits);
/** Bits of each of the two stored numbers of a normal, 8..16; 0: no normals. Without this call 0. */
int imgeo_publisher_set_normals(imgeo_publisher* publisher, uint32_t bits);
/** Components of a colour, 3 or 4; 0: no colours. Without this call 0. */
int imgeo_publisher_set_colors(imgeo_publisher* publisher, uint32_t components);
/**
 * Components of the values, 0..4, the minimum and the maximum of each in `ranges`, and bits of a stored value, 8..24.
 */
int imgeo_publisher_set_values(imgeo_publisher* publisher, uint32_t components, const double* ranges, uint32_t bits);
/** Frames per second, at most 1000; faster ones are dropped. 0: no limit. */
int imgeo_publisher_set_rate(imgeo_publisher* publisher, double rate);

/** The token that viewers of this stream state in `?token=`, at most 256 bytes; NULL: none. Without this call none. */
int imgeo_publisher_set_view_token(imgeo_publisher* publisher, const char* token);

/** Publishes by a server of its own: "127.0.0.1", 8090; port 0: any free one. */
int imgeo_publisher_listen(imgeo_publisher* publisher, const char* host, uint16_t port);
/** Publishes to a server elsewhere, "http://host:8090", with its token for publishers; NULL: none. */
int imgeo_publisher_connect(imgeo_publisher* publisher, const char* server, const char* token);

/**
 * Publishes the vertices of this moment and never waits for a viewer: x y z of each vertex, and normals (x y z),
 * colours (0..1, sRGB) and values where the stream has them, otherwise NULL. `time` is in seconds; NaN: seconds since
 * 1970.
 */
int imgeo_publisher_publish(imgeo_publisher* publisher, double time, const float* positions, const float* normals,
                            const float* colors, const float* values);

/** Sums since imgeo_publisher_create(). */
imgeo_totals imgeo_publisher_totals(const imgeo_publisher* publisher);
/** Where viewers find the stream; empty before it is published. Valid until imgeo_publisher_destroy(). */
const char* imgeo_publisher_url(const imgeo_publisher* publisher);
/** The sentence about the last failure in this thread; empty if there was none. Valid until the next call. */
const char* imgeo_publisher_error(void);

#ifdef __cplusplus
}
#endif

#endif
