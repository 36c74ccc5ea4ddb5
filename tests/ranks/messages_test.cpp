// What ranks tell each other, on any number of them.
#include <gtest/gtest.h>

#include <cstring>
#include <string>

#include "ranks/neighbour_messages.hpp"
#include "ranks/packing.hpp"
#include "tests/ranks/world.hpp"

namespace tanktread::ranks::test {
namespace {

TEST(RanksWorld, finds_the_highest_number) {
  const auto& world = *all_ranks;
  EXPECT_EQ(world.highest(world.rank()), world.size() - 1);
  EXPECT_EQ(world.highest(-world.rank()), 0);
}

/// What a rank sends in a direction in a round.
std::string text(int rank, const Triple& direction, int round) {
  std::string text = std::to_string(rank) + ":" + std::to_string(direction[0]) +
                     std::to_string(direction[1]) + std::to_string(direction[2]) + ":" +
                     std::to_string(round);
  text.resize(20);
  return text;
}

TEST(RanksWorld, brings_messages_from_rank_to_rank) {
  const auto& world = *all_ranks;
  if (world.size() == 1) GTEST_SKIP() << "there is no other rank";
  const int next = (world.rank() + 1) % world.size(),
            before = (world.rank() + world.size() - 1) % world.size();
  const std::vector<double> numbers = {1.5, -2.0 * world.rank()};
  const auto message = [&](int round) {
    return Packing().put(round).put_all(numbers).put_text("from " + std::to_string(world.rank()));
  };
  // Small ones may be on the way both ways at once; MPI keeps them.
  for (int round = 0; round < 3; ++round) world.send(next, message(round).bytes());
  for (int round = 0; round < 3; ++round) {
    Unpacking unpacking(world.receive(before));
    EXPECT_EQ(unpacking.take<int>(), round);
    EXPECT_EQ(unpacking.take_all<double>(), (std::vector<double>{1.5, -2.0 * before}));
    EXPECT_EQ(unpacking.take_text(), "from " + std::to_string(before));
    EXPECT_THROW(unpacking.take<char>(), std::logic_error);
  }
}

// That portions come together again; not that they are needed, which takes two gigabytes to see.
TEST(RanksWorld, brings_a_message_that_goes_in_two_portions) {
  const auto& world = *all_ranks;
  if (world.size() != 2) GTEST_SKIP() << "is of two ranks: a rank with it has 256 MB";
  constexpr std::size_t n = World::most_bytes_at_once + 5;
  if (!world.is_first()) {
    std::vector<std::byte> bytes(n);
    for (std::size_t k = 0; k < n; k += 1013) bytes[k] = std::byte(k % 251);
    bytes.back() = std::byte(77);
    world.send(0, bytes);
    return;
  }
  const auto bytes = world.receive(1);
  ASSERT_EQ(bytes.size(), n);
  std::size_t n_wrong = 0;
  for (std::size_t k = 0; k < n; k += 1013) n_wrong += bytes[k] != std::byte(k % 251);
  EXPECT_EQ(n_wrong, 0);
  EXPECT_EQ(bytes.back(), std::byte(77));
}

/// What a rank writes to another in a round; longer from one rank to the next.
Message letter(int from, int to, int round) {
  Packing packing;
  packing.put_text("from " + std::to_string(from) + " to " + std::to_string(to))
      .put(round)
      .put_all(std::vector<int>(static_cast<std::size_t>(100 * from + round), to));
  return {to, packing.take_bytes()};
}

/// Whether a rank writes to another in a round: some to many, some to none, some to themselves.
bool writes(int from, int to, int round) {
  return (from * 7 + to * 3 + round) % 3 == 0;
}

// Nobody is told who writes to whom. Rounds follow each other, so that a rank may be a round behind.
TEST(RanksWorld, exchanges_messages_of_which_no_receiver_knows) {
  const auto& world = *all_ranks;
  for (int round = 0; round < 20; ++round) {
    std::vector<Message> outgoing;
    for (int to = world.size() - 1; to >= 0; --to)
      if (writes(world.rank(), to, round)) outgoing.push_back(letter(world.rank(), to, round));
    const auto incoming = world.exchange(outgoing);
    std::size_t n_expected = 0;
    for (int from = 0; from < world.size(); ++from) {
      if (!writes(from, world.rank(), round)) continue;
      ASSERT_LT(n_expected, incoming.size());
      EXPECT_EQ(incoming[n_expected].rank, from);
      EXPECT_EQ(incoming[n_expected++].bytes, letter(from, world.rank(), round).bytes);
    }
    EXPECT_EQ(incoming.size(), n_expected);
  }
}

TEST(RanksWorld, exchanges_messages_of_known_senders) {
  const auto& world = *all_ranks;
  for (int round = 0; round < 20; ++round) {
    std::vector<Message> outgoing;
    std::vector<int> senders;
    for (int other = 0; other < world.size(); ++other) {
      if (writes(world.rank(), other, round)) outgoing.push_back(letter(world.rank(), other, round));
      if (writes(other, world.rank(), round)) senders.push_back(other);
    }
    const auto incoming = world.exchange(outgoing, senders);
    ASSERT_EQ(incoming.size(), senders.size());
    for (std::size_t k = 0; k < senders.size(); ++k) {
      EXPECT_EQ(incoming[k].rank, senders[k]);
      EXPECT_EQ(incoming[k].bytes, letter(senders[k], world.rank(), round).bytes);
    }
  }
}

TEST(RanksWorld, gathers_the_numbers_of_all) {
  const auto& world = *all_ranks;
  const auto of = [](int rank) {
    return std::vector<double>(static_cast<std::size_t>(rank % 3), 0.1 * rank);
  };
  std::vector<double> expected;
  for (int rank = 0; rank < world.size(); ++rank) {
    const auto numbers = of(rank);
    expected.insert(expected.end(), numbers.begin(), numbers.end());
  }
  EXPECT_EQ(world.all_numbers(of(world.rank())), expected);
}

// Along every axis of every division, with walls and without: an axis of two ranks has the same neighbour on
// both sides, one of one rank itself, and none may be mistaken for the other. A rank may be late.
TEST(RanksMessages, come_from_where_they_were_sent) {
  const auto& world = *all_ranks;
  for (const bool periodic : {true, false}) {
    for (int x = 1; x <= world.size(); ++x) {
      for (int y = 1; x * y <= world.size(); ++y) {
        if (world.size() % (x * y) != 0) continue;
        const Division division({{30, 30, 30}, {true, true, periodic}}, {x, y, world.size() / (x * y)});
        std::vector<Triple> directions;
        for (int d = 0; d < 27; ++d) {
          const Triple direction = {d % 3 - 1, d / 3 % 3 - 1, d / 9 - 1};
          if (d != 13 && division.neighbour(world.rank(), direction)) directions.push_back(direction);
        }
        std::vector<std::string> out(directions.size(), std::string(20, '-')), in = out;
        std::vector<NeighbourMessage> messages;
        for (std::size_t k = 0; k < directions.size(); ++k)
          messages.push_back(
              {directions[k], std::as_bytes(std::span(out[k])), std::as_writable_bytes(std::span(in[k]))});
        if (World::library() == std::string("none")) {
          EXPECT_THROW(NeighbourMessages(world, division, messages), std::logic_error);
          continue;
        }
        NeighbourMessages exchange(world, division, messages);
        for (int round = 0; round < 4; ++round) {
          for (std::size_t k = 0; k < directions.size(); ++k) {
            const auto sent = text(world.rank(), directions[k], round);
            std::memcpy(out[k].data(), sent.data(), sent.size());
          }
          exchange.start();
          exchange.finish();
          for (std::size_t k = 0; k < directions.size(); ++k) {
            const auto& d = directions[k];
            EXPECT_EQ(in[k], text(*division.neighbour(world.rank(), d), {-d[0], -d[1], -d[2]}, round));
          }
        }
      }
    }
  }
}

// Whoever is destroyed in the middle gives up what is under way, and does not wait.
TEST(RanksMessages, may_be_given_up) {
  const auto& world = *all_ranks;
  if (World::library() == std::string("none")) GTEST_SKIP() << "without MPI there are no messages";
  const Division division({{30, 30, 30}}, {1, 1, world.size()});
  for (int round = 0; round < 3; ++round) {
    std::string out(100, 'a'), up(100, 'b'), down(100, 'c');
    const std::vector<NeighbourMessage> messages = {
        {{0, 0, 1}, std::as_bytes(std::span(out)), std::as_writable_bytes(std::span(up))},
        {{0, 0, -1}, std::as_bytes(std::span(out)), std::as_writable_bytes(std::span(down))}};
    NeighbourMessages exchange(world, division, messages);
    if (round < 2 || world.is_first()) exchange.start();
  }
  world.wait_for_all();
}

TEST(RanksMessages, need_a_neighbour) {
  const Division division({{30, 30, 30}, {true, true, false}}, {1, 1, all_ranks->size()});
  std::string out(1, 'a'), in(1, 'b');
  const std::vector<NeighbourMessage> messages = {
      {{0, 0, -1}, std::as_bytes(std::span(out)), std::as_writable_bytes(std::span(in))}};
  if (all_ranks->is_first()) {
    EXPECT_THROW(NeighbourMessages(*all_ranks, division, messages), std::logic_error);
  }
}

}  // namespace
}  // namespace tanktread::ranks::test
