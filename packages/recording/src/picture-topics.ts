/** Names of the topics under which cameras' pictures and videos are recorded. */

const PICTURES = '/farpoint/pictures/';
const VIDEOS = '/farpoint/videos/';

export const pictureTopics = (cameras: readonly string[]): string[] => cameraTopics(PICTURES, cameras);
export const videoTopics = (cameras: readonly string[]): string[] => cameraTopics(VIDEOS, cameras);

/**
 * A camera's name with `_` in place of characters that are invalid in topics: `Front` and `/front/image_raw` become
 * `Front` and `front_image_raw`.
 */
function cameraTopics(prefix: string, cameras: readonly string[]): string[] {
  const taken = new Set<string>();
  return cameras.map((camera) => {
    const plain = camera.replace(/^\/+/, '').replaceAll(/[^A-Za-z0-9_]/g, '_') || 'camera';
    const name = /^[0-9]/.test(plain) ? `_${plain}` : plain;
    let free = name;
    for (let n = 2; taken.has(free); n++) free = `${name}_${n}`;
    taken.add(free);
    return prefix + free;
  });
}
