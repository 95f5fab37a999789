/** Says whether the surface has the colours of its camera's video, and if not, why. */
import type { PictureUse } from '@farpoint/cloud-view';
import type { VideoColourFigures } from '../take/video/video-colour.ts';

const OWN = 'the points’ own';

/** @returns `null` if the robot sends no video of its depth camera */
export function videoColourWords({ state, share, use }: VideoColourFigures): string | null {
  switch (state) {
    case 'not-offered':
    case 'no-surface':
    case 'other-colours':
      return null;
    case 'painted':
      return share > 0.95 ? 'from the video' : `from the video for ${Math.round(share * 100)} %`;
    case 'switched-off':
      return OWN;
    case 'not-in-step':
      return `${OWN}: video and points are not in step`;
    case 'not-watched':
      return `${OWN}: the video is off`;
    case 'no-picture':
      return `${OWN}: no video comes`;
    case 'late':
      return `${OWN}: the video comes too late`;
    case 'no-match':
      return `${OWN}: ${misfitWords(use)}`;
  }
}

/** Why a picture paints nothing. */
function misfitWords(use: PictureUse | null): string {
  switch (use) {
    case 'other-shape':
      return 'the video’s shape is another';
    case 'too-large':
      return 'the video is too large';
    case 'unreadable':
      return 'this browser cannot paint with the video';
    default:
      return 'no picture was captured with them';
  }
}
