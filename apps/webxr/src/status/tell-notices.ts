/** Tells people what happens to the session and to their commands, as short notices. */
import { finalLosses, type RobotClient } from '@farpoint/operator';
import type { Notices } from '../state/notices.ts';
import { Takeover } from '../state/takeover.ts';
import { missingGripWords, takenOverWords } from './driving-words.ts';
import { handoverEndWords } from './handover-words.ts';
import { failureWords, gripLossWords, rejectionWords, wordsOfLoss, wordsOfRejection } from './words.ts';

export function tellNotices(client: RobotClient, notices: Notices): void {
  const takeover = new Takeover();
  const { driver, link } = client;
  // What follows from a takeover must not hide it.
  const isDisplaced = () => takeover.by(driver.isGripped) !== null;
  client.on('loss', (loss) => {
    // Of those that are final, a panel tells.
    if (!finalLosses.has(loss)) notices.tell(wordsOfLoss(loss, client.link), 'warning');
  });
  client.on('grantExpires', (inS) => notices.tell(`Your grant ends in ${inS} s.`, 'warning'));
  client.on('refused', (message) => notices.tell(message, 'warning'));
  client.on('welcome', ({ name }) => notices.tell(`Connected to ${name}`, 'good'));
  client.on('commandRejected', ({ reason, detail }) => {
    console.info('command refused:', reason, detail);
    if (reason === 'not-lease-holder' && isDisplaced()) return;
    notices.tell(wordsOfRejection(reason, client.driver.holder), 'warning');
  });
  client.on('otherDrives', () => {
    if (!isDisplaced()) notices.tell(rejectionWords['not-lease-holder'], 'warning');
  });
  client.on('session', () => takeover.reset());
  client.on('lease', ({ holder, driver: name = null }) => {
    if (takeover.onLease(holder, name)) notices.tell(takenOverWords(name), 'warning');
  });
  client.on('handover', ({ ended, ...handover }) => {
    if (ended === undefined) return;
    // Nobody has taken what was given.
    if (ended === 'accepted' && driver.holder !== 'you') takeover.reset();
    const { text, tone } = handoverEndWords({ ...handover, ended });
    notices.tell(text, tone);
  });
  client.on('gripMissing', (device) => {
    const role = link.session.welcome?.access?.role ?? null;
    const drives = link.session.about?.drives ?? true;
    if (link.phase === 'live' && drives) notices.tell(missingGripWords(device, driver.holder, role));
  });
  client.on('gripLost', (loss) => notices.tell(gripLossWords[loss], 'warning'));
  client.on('robotFault', (message) => notices.tell(`The robot reports: ${message}`, 'warning'));
  client.on('failed', ({ detail }) => {
    console.error('cloud worker:', detail);
    notices.failure.value = failureWords.workerFailed;
  });
}
