/** Names of the topics that cameras' pictures are recorded in. */

const PREFIX = '/farpoint/pictures/';

/** A camera's name with `_` for what topics may not be called: `Front` and `/front/image_raw` become `Front` and `front_image_raw`. */
export function pictureTopics(cameras: readonly string[]): string[] {
  const taken = new Set<string>();
  return cameras.map((camera) => {
    const plain = camera.replace(/^\/+/, '').replaceAll(/[^A-Za-z0-9_]/g, '_') || 'camera';
    const name = /^[0-9]/.test(plain) ? `_${plain}` : plain;
    let free = name;
    for (let n = 2; taken.has(free); n++) free = `${name}_${n}`;
    taken.add(free);
    return PREFIX + free;
  });
}
