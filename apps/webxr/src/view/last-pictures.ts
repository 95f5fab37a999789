/** The last picture that this page has drawn of each robot, small, for the list of robots. Kept in this tab only. */

/** Size of a picture, CSS pixels of the list. */
export const LAST_PICTURE = { width: 128, height: 72 };
/** Of so many robots, at most: then the one that was seen longest ago is forgotten. */
export const MOST_PICTURES = 64;

/** A picture and when it was drawn. */
export interface LastPicture<Picture> {
  readonly picture: Picture;
  readonly drawnMs: number;
}

export class LastPictures<Picture> {
  readonly #pictures = new Map<string, LastPicture<Picture>>();

  /** @param draw makes a new picture, or draws over the robot's earlier one */
  keep(robotId: string, draw: (earlier: Picture | null) => Picture, drawnMs: number): void {
    const picture = draw(this.#pictures.get(robotId)?.picture ?? null);
    // The last in the map is the newest.
    this.#pictures.delete(robotId);
    this.#pictures.set(robotId, { picture, drawnMs });
    for (const oldest of this.#pictures.keys()) {
      if (this.#pictures.size <= MOST_PICTURES) return;
      this.#pictures.delete(oldest);
    }
  }

  of(robotId: string): LastPicture<Picture> | null {
    return this.#pictures.get(robotId) ?? null;
  }
}
