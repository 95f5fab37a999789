/** What is said about who is here, and about requests for the drive and offers of it. */
import type { Role } from '@farpoint/protocol';

export const people = {
  /** A name that nothing proves. */
  claimed: (name: string) => `“${name}”`,
  you: 'you',
  activities: { watch: 'watching', drive: 'may drive', supervise: 'supervisor' } satisfies Record<
    Role,
    string
  >,
  driving: 'driving',
  drivingBriefly: 'driving for less than 1 min',
  drivingFor: (hours: number, minutes: number) =>
    `driving for ${hours === 0 ? '' : `${hours} h `}${minutes} min`,
  away: 'away: not heard from',
  /** @param activities e.g. driving, away */
  person: (name: string, activities: readonly string[]) => `${name} (${activities.join(', ')})`,
  onlyYou: 'Only you are here',
  count: (total: number) => `${total} are here`,
  andDrives: (count: string, name: string) => `${count}: ${name} drives`,
  andYouDrive: (count: string) => `${count}: you drive`,
  offer: 'Offer the drive',
  offerTo: (name: string) => `Offer the drive to ${name}`,
  offerItTo: (person: string) => `Offer it to ${person}`,
  end: 'End session…',
  endOf: (name: string) => `End the session of ${name}…`,
  endTitle: (name: string) => `End the session of ${name}?`,
  handOver: 'Hand over',
  giveUp: 'Give up the drive',
  asks: (name: string) => `${name} asks to drive`,
  offers: (name: string) => `${name} offers you the drive`,
  give: 'Give the drive',
  take: 'Take the drive',
  refuse: 'Refuse',
  youAsked: (name: string) => `You have asked ${name} for the drive`,
  youOffered: (name: string) => `You have offered ${name} the drive`,
  /** What has become of a request or an offer. */
  yourAsk: 'Your request for the drive',
  yourOffer: 'Your offer of the drive',
  theirAsk: (name: string) => `${name}’s request for the drive`,
  theirOffer: (name: string) => `${name}’s offer of the drive`,
  hasRefused: (name: string) => `${name} has refused: the drive has not changed hands.`,
  refused: 'Refused: the drive has not changed hands.',
  takenBack: (what: string) => `${what} was taken back.`,
  noAnswer: (name: string) => `${name} did not answer: the drive has not changed hands.`,
  youNoAnswer: (name: string) => `You did not answer ${name}: the drive has not changed hands.`,
  driverChanged: (what: string) => `${what} has ended: the driver has changed.`,
  hasLeft: (what: string, name: string) => `${what} has ended: ${name} has left.`,
  /** @param who has pressed STOP */
  stopped: (what: string, who: string) => `${what} has ended: ${who} pressed STOP.`,
  presser: { you: 'you', anOperator: 'an operator' },
  youDriveNow: (name: string) => `${name} has accepted: you drive now. Press the grip anew to drive.`,
  youDriveByOffer: (name: string) => `You drive now, by ${name}’s offer. Press the grip anew to drive.`,
  acceptedDrives: (name: string) => `${name} has accepted: ${name} drives now.`,
  drivesNow: (name: string) => `${name} drives now.`,
};
