/**
 * How what brings media is started again, and when it is given up: cameras, microphones, their programs and their
 * threads. The same numbers for all, so that an unplugged device is treated alike, whatever reads it.
 */

/**
 * Wait before it is started again, ms: it doubles. Chosen: a device that was unplugged is back in seconds; a lasting
 * fault costs a start in 10 s (docs/video.md, docs/sound.md).
 */
export const MEDIA_RETRY = { firstMs: 500, mostMs: 10_000 };

/**
 * What has worked for so long has succeeded: the next wait is short again, ms. As long as the longest wait, so that what
 * fails soon is not started ever faster.
 */
export const MEDIA_SUCCESS_MS = MEDIA_RETRY.mostMs;

/**
 * When what says nothing is given up; it says twice a second that it lives. Chosen: the first start after an installation
 * looks at each plugin, and a thread loads the code of ROS and the simulator; later, a busy computer delays no message
 * for so long (docs/video.md, docs/sound.md).
 */
export const MEDIA_SIGNS_OF_LIFE = { firstMs: 30_000, silenceMs: 5000, checkMs: 500 };
