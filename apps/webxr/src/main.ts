import './ui/theme.css';
import './ui/style.css';
import './ui/about.css';
import './ui/cloud-panel.css';
import './ui/picture-panels.css';
import './ui/robots.css';
import './ui/sound.css';
import './ui/minimap.css';
import './goals/goals.css';
import './robot-commands/commands.css';
import './people/people.css';
import './ui/near.css';
import './ui/inputs.css';
import './ui/small-screens.css';
import { transformSupport } from '@farpoint/operator';
import { App } from './app.ts';
import { keepAwake } from './display/keep-awake.ts';
import { applyDisplay } from './display/stored-display.ts';
import { liveSettings } from './live-settings.ts';
import { registerOfflineWorker } from './offline/register.ts';
import { readSettings } from './settings.ts';
import { Notices } from './state/notices.ts';
import { failureWords, forbiddenAddressWords } from './status/words.ts';
import { hideToken, loadStored, pageOrigin } from './stored-settings.ts';
import { elements } from './ui/elements.ts';
import { showNotices } from './ui/notice.ts';
import { answerWall } from './wall/answer-wall.ts';

applyDisplay();
const settings = liveSettings(
  readSettings(new URLSearchParams(window.location.search), loadStored(), pageOrigin()),
);
hideToken(settings);
const notices = new Notices();

function start(): void {
  const transform = transformSupport();
  const isDirect = settings.bridge === null;
  if (isDirect && typeof RTCPeerConnection === 'undefined') {
    notices.failure.value = failureWords.noWebRtc;
    return;
  }
  if (isDirect && transform === 'none') {
    notices.failure.value = failureWords.noTransform;
    return;
  }
  try {
    const app = new App(settings, transform, notices);
    app.start();
    keepAwake(app.state.link.live);
    if (import.meta.env.MODE === 'production') registerOfflineWorker();
    answerWall(app.state, () => elements.estop.click());
    // The deployed page leaves this out. `vite build --mode testing` includes it.
    if (import.meta.env.MODE === 'testing')
      void import('./testing/test-hooks.ts').then(({ installTestApi }) => installTestApi(app));
  } catch (error) {
    console.error(error);
    notices.failure.value = failureWords.noWebGl2;
  }
}

// The server says where its page may connect to. Without this, a forbidden address only looks unreachable.
document.addEventListener('securitypolicyviolation', ({ effectiveDirective, blockedURI }) => {
  if (effectiveDirective === 'connect-src') notices.tell(forbiddenAddressWords(blockedURI), 'bad');
});
showNotices(notices);
start();
