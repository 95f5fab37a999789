export { testDomain } from './helpers.ts';
export { CLOUD_QOS, type MarkedCloud, readMarkedCloud } from './marked-cloud.ts';
export { findPeer, PEER_REMEDY, Peer, type PeerKind, type PeerOptions } from './peers.ts';
export { findServicePeer, ServicePeer, type ServicePeerCommand } from './service-peer.ts';
