#pragma once
// Exchange of halo values between ranks and across periodic sides. No other code passes grid fields to MPI.
#include <initializer_list>
#include <vector>

#include "grid/fields.h"

namespace seiche {

template <int Dim>
class Halo {
 public:
  // Collective. `boxes` are the owned boxes of all ranks.
  Halo(const Layout<Dim>& layout, const std::vector<Box<Dim>>& boxes, const Communicator& ranks);

  // Overwrites every stored site that another rank (or a periodic image) has authority over. Collective.
  void fill_ghosts(std::initializer_list<double*> fields) const { exchange<double>(fields); }
  void fill_ghosts(std::initializer_list<std::int64_t*> fields) const { exchange<std::int64_t>(fields); }
  void fill_ghosts(std::initializer_list<char*> fields) const { exchange<char>(fields); }
  void fill_ghosts(CellField<Dim>& f) const { fill_ghosts({f.data()}); }
  void fill_ghosts(NodeField<Dim>& f) const { fill_ghosts({f.data()}); }
  template <class T>
  void fill_ghosts(FaceField<Dim, T>& f) const {
    if constexpr (Dim == 2) fill_ghosts({f[0].data(), f[1].data()});
    if constexpr (Dim == 3) fill_ghosts({f[0].data(), f[1].data(), f[2].data()});
  }

  // The same after a change of `changed` sites, owned ones: f has new values there and `mark` is `value`, and both
  // agreed between ranks before. Sends these values with their places. Collective.
  void fill_changed(const std::vector<Site>& changed, char value, double* f, char* mark) const;

  // A halo of those ghosts alone that are among `wanted`, sorted. Only for fill_ghosts(). Collective.
  Halo part(const std::vector<Site>& wanted) const;

 private:
  struct Peer {
    int rank;
    std::vector<Site> send, receive;  // sites in the order of the message
  };
  // A site that this rank sends, with its place in the message to a peer; peer -1: to its own image, a site.
  struct Outgoing {
    Site site;
    int peer;
    Site place;
  };
  explicit Halo(const Communicator& ranks) : ranks_(ranks) {}
  void list_outgoing();
  template <class T>
  void exchange(std::initializer_list<T*> fields) const;

  Communicator ranks_;
  std::vector<Peer> peers_;                // other ranks
  std::vector<Site> copy_from_, copy_to_;  // this rank's own periodic images
  std::vector<Outgoing> outgoing_;         // by site
  std::vector<bool> is_sent_;              // by site
};

}  // namespace seiche
