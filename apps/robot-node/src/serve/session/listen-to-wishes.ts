/** Hands what an operator wants of the streams to the session's parts. */

import type { PathBudget } from '../../send/budgets/path-budget.ts';
import type { PictureSender } from '../../send/pictures/picture-sender.ts';
import type { OperatorSound } from '../../send/sound/operator-sound.ts';
import type { OperatorVideos } from '../../send/video/operator-videos.ts';
import type { OperatorSessionEvents, OperatorSessionOptions } from './operator-session-options.ts';
import type { OperatorWishes } from './operator-wishes.ts';
import type { WantedClouds } from './wanted-clouds.ts';

export interface WishedParts {
  clouds: WantedClouds;
  videos: OperatorVideos;
  pictures: PictureSender;
  sound: OperatorSound;
  budget: PathBudget;
  /** Discards what is waiting to be sent. */
  clear(): void;
  budgets: OperatorSessionOptions['budgets'];
  events: Pick<OperatorSessionEvents, 'onCloudFormats'>;
}

export function listenToWishes(wishes: OperatorWishes, parts: WishedParts): void {
  const { clouds, videos, pictures, sound, budget, budgets, events } = parts;
  /** Its part of the path changes, or what it makes of it. */
  const budgeted =
    <Wish extends unknown[]>(take: (...wish: Wish) => void) =>
    (...wish: Wish): void => {
      take(...wish);
      budgets.update();
    };
  wishes.onStreamSwitch = budgeted((running) => {
    if (!running) parts.clear();
  });
  wishes.onSensors = budgeted((sensors) => {
    clouds.sensors = new Set(sensors);
    events.onCloudFormats();
  });
  wishes.onCloudFormats = budgeted((formats) => {
    clouds.formats = new Set(formats);
    events.onCloudFormats();
  });
  wishes.onDisplay = budgeted(({ framesPerSecond, points }) => {
    clouds.pace.display = { framesPerSecond, points };
  });
  wishes.onVideos = budgeted((wanted, barcode) => videos.want(wanted, barcode));
  wishes.onShares = budgeted((shares) => budget.weigh(shares));
  wishes.onPictures = (cameras) => pictures.watch(cameras);
  wishes.onListen = (on) => sound.listen(on);
  wishes.onSpeak = (held) => sound.speak(held);
}
