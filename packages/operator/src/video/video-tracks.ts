import type { VideoTrack } from './video-track.ts';

/**
 * The tracks of one session's videos. Tracks come with the connection, before the robot has said what they show; each is
 * announced as soon as the robot's list has it.
 */
export class VideoTracks {
  readonly #announce: (track: VideoTrack) => void;
  readonly #tracks = new Map<number, { track: VideoTrack; announced: boolean }>();
  #listed = 0;

  constructor(announce: (track: VideoTrack) => void) {
    this.#announce = announce;
  }

  /** A session begins. */
  reset(): void {
    this.#tracks.clear();
    this.#listed = 0;
  }

  /** A video's track has come. One that comes again, e.g. after another offer, is not announced twice. */
  add(track: VideoTrack): void {
    if (this.#tracks.get(track.video)?.track.track === track.track) return;
    this.#tracks.set(track.video, { track, announced: false });
    this.#tell();
  }

  /** The robot has listed this many videos. */
  list(videos: number): void {
    this.#listed = videos;
    this.#tell();
  }

  #tell(): void {
    for (const [video, entry] of this.#tracks) {
      if (entry.announced || video >= this.#listed) continue;
      entry.announced = true;
      this.#announce(entry.track);
    }
  }
}
