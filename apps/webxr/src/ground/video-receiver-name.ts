/** The ways to receive videos. */

/**
 * `track`: the browser receives and decodes, and its track processor gives each frame. `native`: the browser receives and decodes, and tells when it shows another frame. `webcodecs`: a worker takes the
 * encoded frames and decodes them.
 */
export const VIDEO_RECEIVERS = ['track', 'native', 'webcodecs'] as const;
export type VideoReceiverName = (typeof VIDEO_RECEIVERS)[number];
