/**
 * Gives each track of Janus' offer a stream of its own. Janus puts all into one, and a browser delays the tracks of one
 * stream to play them in step, by rules of its own.
 */
export function separateStreams(sdp: string): string {
  return sdp.replaceAll(/^a=msid:\S+ (\S+)/gm, 'a=msid:farpoint-$1 $1');
}
